// Writing OpenEXR files.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>

#include <cassert>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <system_error>

#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"
#include "vpm/image/exr.h"

namespace vpm {
namespace {

using std::filesystem::path;

/// Adds a channel for each letter, of the first components of `image`, to a header and to the buffer that OpenEXR
/// writes from.
void add_channels(Imf::Header& header, Imf::FrameBuffer& buffer, const std::string& prefix, const std::string& letters,
                  const Image& image) {
  const Imath::V2i first = header.dataWindow().min;
  const auto across = static_cast<intptr_t>(sizeof(Rgb)), down = across * image.width;
  for (int c = 0; c < static_cast<int>(letters.size()); ++c) {
    const std::string name = prefix + letters[static_cast<size_t>(c)];
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    const auto pixels = reinterpret_cast<intptr_t>(&image.pixels.data()[0][c]);  // only read
    auto* const origin = reinterpret_cast<char*>(pixels - first.x * across - first.y * down);
    buffer.insert(name, Imf::Slice(Imf::FLOAT, origin, static_cast<size_t>(across), static_cast<size_t>(down)));
  }
}

/// A picture of the image's size, or what `part` says.
Imf::Header header_of(const Image& image, const std::optional<ExrWindow>& part) {
  const ExrWindow window = part.value_or(ExrWindow{{0, 0, image.width, image.height}, image.width, image.height});
  const auto& [x0, y0, x1, y1] = window.data;
  assert(window.data.width() == image.width && window.data.height() == image.height);
  const Imath::Box2i display({0, 0}, {window.width - 1, window.height - 1}), data({x0, y0}, {x1 - 1, y1 - 1});
  return {display, data};
}

/// Adds the channel A, whose rows are all `ones`: programs that take the fourth channel for alpha would else take
/// another.
void add_alpha(Imf::Header& header, Imf::FrameBuffer& buffer, const std::vector<float>& ones) {
  constexpr auto kAcross = static_cast<intptr_t>(sizeof(float));
  const auto row = reinterpret_cast<intptr_t>(ones.data());  // only read
  auto* const origin = reinterpret_cast<char*>(row - header.dataWindow().min.x * kAcross);
  header.channels().insert("A", Imf::Channel(Imf::FLOAT));
  buffer.insert("A", Imf::Slice(Imf::FLOAT, origin, sizeof(float), 0));
}

}  // namespace

void write_exr(const path& file, const Image& radiance, const std::vector<ExrLayer>& layers,
               const std::vector<std::pair<std::string, std::string>>& metadata, const std::optional<ExrWindow>& part) {
  assert(!radiance.pixels.empty());
  TemporaryFile temporary(file);
  errno = 0;
  std::ofstream out(temporary.path(), std::ios::binary);
  try {
    Imf::Header header = header_of(radiance, part);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [key, value] : metadata) {
      assert(header.find(key) == header.end());
      header.insert(key, Imf::StringAttribute(value));
    }
    Imf::FrameBuffer buffer;
    add_channels(header, buffer, "", "RGB", radiance);
    const std::vector<float> ones(static_cast<size_t>(radiance.width), 1.0f);
    add_alpha(header, buffer, ones);
    for (const ExrLayer& layer : layers) {
      assert(layer.image->width == radiance.width && layer.image->height == radiance.height &&
             layer.letters.size() <= 3);
      add_channels(header, buffer, layer.name + ".", layer.letters, *layer.image);
    }
    Imf::StdOFStream stream(out, file.c_str());
    Imf::OutputFile output(stream, header, 0);
    output.setFrameBuffer(buffer);
    output.writePixels(radiance.height);
  } catch (const std::exception& error) {
    throw InputError("cannot write '" + file.string() + "': " + error.what());
  }
  // OpenEXR ends the file in a destructor that cannot report. The stream remembers, and errno says why.
  out.close();
  if (!out)
    throw InputError("cannot write '" + file.string() +
                     "': " + (errno != 0 ? std::generic_category().message(errno) : "the disk did not take all bytes"));
  temporary.commit();
}

}  // namespace vpm
