// Pictures without loss: OpenEXR behind two functions.
#include "vpm/image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <functional>
#include <system_error>

#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"
#include "vpm/image/exr_header.h"

namespace vpm {
namespace {

using std::filesystem::path;
using Names = std::vector<std::string>;

constexpr int kMostPixels = 65536;         // a side
constexpr int64_t kMostBytes = 1ll << 30;  // of one file in memory, as planes and as pixels
constexpr int64_t kMostLinesAtOnce = 256;  // that a compression packs together

[[noreturn]] void refuse_picture(const path& file, const std::string& why) {
  throw InputError("cannot read '" + file.string() + "': " + why);
}

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

/// Throws unless the pixels of `names` can be had in memory.
void check_header(const path& file, const Imf::Header& header, const Names& names) {
  if (header.hasType() && Imf::isDeepData(header.type())) refuse_picture(file, "it holds deep data; flatten it first");
  int64_t channels = 0;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) ++channels;
  for (const std::string& name : names) {
    const Imf::Channel& channel = header.channels()[name];
    if (channel.type == Imf::UINT)
      refuse_picture(file, "channel '" + name + "' is of integers; half or float are read");
    if (channel.xSampling != 1 || channel.ySampling != 1) refuse_picture(file, "channel '" + name + "' is subsampled");
  }
  const Imath::Box2i data = header.dataWindow(), display = header.displayWindow();
  const auto side = [](int lo, int hi) { return int64_t{hi} - lo + 1; };
  int64_t line = side(data.min.x, data.max.x), lines = kMostLinesAtOnce;
  if (header.hasTileDescription()) {
    line = std::max<int64_t>(line, header.tileDescription().xSize);
    lines = std::max<int64_t>(lines, header.tileDescription().ySize);
  }
  const int64_t width = side(display.min.x, display.max.x), height = side(display.min.y, display.max.y);
  const bool sane = width <= kMostPixels && height <= kMostPixels && line <= kMostPixels && lines <= kMostPixels &&
                    width * height * std::max<int64_t>(3, static_cast<int64_t>(names.size())) <= kMostBytes / 8 &&
                    line * lines <= kMostBytes / (8 * std::max<int64_t>(channels, 1));
  if (!sane) {
    refuse_picture(file, "its " + std::to_string(width) + " x " + std::to_string(height) + " pixels of " +
                             std::to_string(channels) + " channels need more than 1 GiB");
  }
}

/// Reads the rows of the data window that lie in the display window into planes over the display window.
void read_rows(Imf::InputPart& part, const Names& names, ExrChannels& result) {
  const Imath::Box2i data = part.header().dataWindow(), display = part.header().displayWindow();
  const auto row_length = static_cast<size_t>(data.max.x - data.min.x + 1);
  std::vector<std::vector<float>> rows(names.size(), std::vector<float>(row_length));
  std::vector<float*> planes;
  Imf::FrameBuffer buffer;
  for (size_t i = 0; i < names.size(); ++i) {
    std::vector<float>& plane = result.planes[names[i]];
    plane.assign(static_cast<size_t>(result.width) * static_cast<size_t>(result.height), 0.0f);
    planes.push_back(plane.data());
    const auto base = reinterpret_cast<intptr_t>(rows[i].data()) - data.min.x * static_cast<intptr_t>(sizeof(float));
    buffer.insert(names[i], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(base), sizeof(float), 0));
  }
  part.setFrameBuffer(buffer);
  const int left = std::max(data.min.x, display.min.x), right = std::min(data.max.x, display.max.x);
  for (int y = std::max(data.min.y, display.min.y); y <= std::min(data.max.y, display.max.y); ++y) {
    part.readPixels(y);
    const auto at = static_cast<size_t>(y - display.min.y) * static_cast<size_t>(result.width);
    for (size_t i = 0; i < names.size() && left <= right; ++i) {
      std::copy_n(&rows[i][static_cast<size_t>(left - data.min.x)], right - left + 1,
                  planes[i] + at + (left - display.min.x));
    }
  }
}

/// Reads the channels that `choose` picks from the names of all channels.
ExrChannels read_channels(const path& file, const std::function<Names(const Names&)>& choose) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) refuse_picture(file, "there is no such file");
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse_picture(file, "permission denied");
  check_exr_header(file);
  try {
    Imf::StdIFStream stream(in, file.c_str());
    Imf::MultiPartInputFile parts(stream, 0);
    const Imf::Header& header = parts.header(0);
    Names all;
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i) all.emplace_back(i.name());
    const Names names = choose(all);
    check_header(file, header, names);

    ExrChannels result;
    result.width = header.displayWindow().max.x - header.displayWindow().min.x + 1;
    result.height = header.displayWindow().max.y - header.displayWindow().min.y + 1;
    const Imath::Box2i data = header.dataWindow(), display = header.displayWindow();
    result.held = common_pixels({data.min.x - display.min.x, data.min.y - display.min.y, data.max.x - display.min.x + 1,
                                 data.max.y - display.min.y + 1},
                                {0, 0, result.width, result.height});
    for (auto i = header.begin(); i != header.end(); ++i) {
      const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute());
      if (text) result.metadata[i.name()] = text->value();
    }
    Imf::InputPart part(parts, 0);
    read_rows(part, names, result);
    return result;
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& failure) {
    refuse_picture(file, failure.what());
  }
}

/// The channels that make red, green and blue.
std::array<std::string, 3> colour_channels(const path& file, const Names& all) {
  const auto has = [&](const char* name) { return std::find(all.begin(), all.end(), name) != all.end(); };
  if (has("R") && has("G") && has("B")) return {"R", "G", "B"};
  if (has("Y") && !has("RY") && !has("BY")) return {"Y", "Y", "Y"};
  if (all.size() == 1) return {all[0], all[0], all[0]};
  std::string list;
  for (const std::string& name : all) list += (list.empty() ? "" : ", ") + name;
  refuse_picture(file, "it needs the channels R, G, B, or Y, or one channel only; it has: " + list);
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

Image read_exr(const path& file) {
  std::array<std::string, 3> colour;
  const ExrChannels channels = read_channels(file, [&](const Names& all) {
    colour = colour_channels(file, all);
    return colour[0] == colour[1] ? Names{colour[0]} : Names(colour.begin(), colour.end());
  });
  Image image(channels.width, channels.height);
  for (int c = 0; c < 3; ++c) {
    const std::vector<float>& plane = channels.planes.at(colour[static_cast<size_t>(c)]);
    for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i][c] = plane[i];
  }
  return image;
}

ExrChannels read_exr_channels(const path& file) {
  return read_channels(file, [](const Names& all) { return all; });
}

std::optional<Image> layer_of(const ExrChannels& file, const std::string& name) {
  Image image(file.width, file.height);
  for (int c = 0; c < 3; ++c) {
    const auto plane = file.planes.find((name.empty() ? "" : name + ".") + "RGB"[c]);
    if (plane == file.planes.end()) return std::nullopt;
    for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i][c] = plane->second[i];
  }
  return image;
}

}  // namespace vpm
