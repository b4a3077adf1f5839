// Reading OpenEXR files: the part that holds the picture, its channels, and its colours as those of Rec. 709.
#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <system_error>

#include "vpm/base/error.h"
#include "vpm/image/exr.h"
#include "vpm/image/exr_header.h"
#include "vpm/image/exr_layers.h"
#include "vpm/image/primaries.h"

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

/// Throws unless the pixels of `names` can be had in memory.
void check_header(const Imf::Header& header, const Names& names) {
  if (header.hasType() && Imf::isDeepData(header.type())) throw InputError("it holds deep data; flatten it first");
  int64_t channels = 0;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) ++channels;
  for (const std::string& name : names) {
    const Imf::Channel& channel = header.channels()[name];
    if (channel.type == Imf::UINT) throw InputError("channel '" + name + "' is of integers; half or float are read");
    if (channel.xSampling != 1 || channel.ySampling != 1) throw InputError("channel '" + name + "' is subsampled");
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
    throw InputError("its " + std::to_string(width) + " x " + std::to_string(height) + " pixels of " +
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

std::vector<ExrPartNames> names_of(const Imf::MultiPartInputFile& file) {
  std::vector<ExrPartNames> parts;
  for (int i = 0; i < file.parts(); ++i) {
    const Imf::Header& header = file.header(i);
    ExrPartNames& part = parts.emplace_back();
    if (header.hasName()) part.part = header.name();
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) part.channels.emplace_back(c.name());
  }
  return parts;
}

/// The sizes and the attributes of a part, without its channels.
ExrChannels frame_of(const Imf::Header& header) {
  ExrChannels result;
  const Imath::Box2i data = header.dataWindow(), display = header.displayWindow();
  result.width = display.max.x - display.min.x + 1;
  result.height = display.max.y - display.min.y + 1;
  result.held = common_pixels({data.min.x - display.min.x, data.min.y - display.min.y, data.max.x - display.min.x + 1,
                               data.max.y - display.min.y + 1},
                              {0, 0, result.width, result.height});
  for (auto i = header.begin(); i != header.end(); ++i)
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute()))
      result.metadata[i.name()] = text->value();
  return result;
}

/// Of a colour space that is named, or of the attribute "chromaticities"; those of Rec. 709 where neither is there.
Primaries primaries_of(const Imf::Header& header, ExrPicture& picture) {
  const auto word = [&](const char* attribute) {
    const auto found = picture.file.metadata.find(attribute);
    return found == picture.file.metadata.end() ? std::string() : found->second;
  };
  const std::string space = word("colorInteropID"), of_oiio = word("oiio:ColorSpace");
  for (const std::string& named : {space, of_oiio})
    if (is_encoded(named))
      throw InputError("its colour space is '" + named + "', whose values are encoded: save it with linear ones");
  if (const std::optional<Primaries> named = primaries_named(space)) return *named;
  if (Imf::hasChromaticities(header)) {
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    return {{c.red.x, c.red.y}, {c.green.x, c.green.y}, {c.blue.x, c.blue.y}, {c.white.x, c.white.y}};
  }
  if (const std::optional<Primaries> named = primaries_named(of_oiio)) return *named;
  for (const std::string& unknown : {space, of_oiio})
    if (!unknown.empty())
      picture.notes.push_back("its colour space, '" + unknown +
                              "', is not known: its colours are taken for linear ones of Rec. 709");
  return {};
}

Image image_of(const ExrChannels& file, const std::array<std::string, 3>& colour) {
  Image image(file.width, file.height);
  for (int c = 0; c < 3; ++c) {
    const std::vector<float>& plane = file.planes.at(colour[static_cast<size_t>(c)]);
    for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i][c] = plane[i];
  }
  return image;
}

/// Grey stays grey whatever its primaries.
void convert_colours(const Primaries& primaries, ExrPicture& picture) {
  if (primaries.are_those_of_rec709()) return;
  const glm::dmat3 matrix = to_rec709(primaries);
  for (Rgb& pixel : picture.image.pixels) pixel = Rgb(matrix * Rgbd(pixel));
  picture.notes.push_back(conversion_text(primaries));
}

ExrPicture read_picture(Imf::MultiPartInputFile& parts, const std::string& layer, ExrPlanes planes) {
  const std::vector<ExrPartNames> all = names_of(parts);
  const ExrColour colour = choose_colour(all, layer);
  const auto number = static_cast<int>(colour.part);
  const Imf::Header& header = parts.header(number);
  const bool grey = colour.channels[0] == colour.channels[1];
  Names names(colour.channels.begin(), colour.channels.begin() + (grey ? 1 : 3));
  for (const std::string& channel : all[colour.part].channels)
    if (planes == ExrPlanes::statistics && (channel.starts_with("variance.") || channel.starts_with("bias.")))
      names.push_back(channel);
  if (planes == ExrPlanes::all) names = all[colour.part].channels;
  check_header(header, names);
  ExrPicture picture;
  picture.file = frame_of(header);
  Imf::InputPart part(parts, number);
  read_rows(part, names, picture.file);
  picture.image = image_of(picture.file, colour.channels);
  picture.cube = Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE;
  if (!grey) convert_colours(primaries_of(header, picture), picture);
  return picture;
}

}  // namespace

ExrPicture read_exr_picture(const path& file, const std::string& layer, ExrPlanes planes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) refuse_picture(file, "there is no such file");
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse_picture(file, "permission denied");
  check_exr_header(file);
  try {
    Imf::StdIFStream stream(in, file.c_str());
    Imf::MultiPartInputFile parts(stream, 0);
    return read_picture(parts, layer, planes);
  } catch (const std::exception& failure) {
    refuse_picture(file, failure.what());
  }
}

Image read_exr(const path& file) { return read_exr_picture(file, "", ExrPlanes::colour).image; }

ExrChannels read_exr_channels(const path& file) { return read_exr_picture(file).file; }

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
