// Pictures without loss: OpenEXR files of linear float channels.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vpm/image/image.h"

namespace vpm {

/// A further picture in the same file, of the same size as the main one.
struct ExrLayer {
  std::string name;  // of its channels: name.R, name.G, name.B
  const Image* image;
  std::string letters = "RGB";  // others in place of these, and as few as the layer needs, from the first component on
};

/// Which part of a picture of width x height pixels a file holds.
struct ExrWindow {
  PixelRect data;
  int width, height;
};

/// Writes the float channels R, G, B, A = 1 and those of the layers into one part, ZIP compressed (lossless), and each
/// pair of `metadata` as a string attribute; the keys must be distinct and none of the format's own names. Equal
/// arguments give equal bytes: no time stamp. The file appears whole or not at all; throws InputError where it cannot
/// be written. Where the images are a part of a picture, `part` says which: they are the file's data window, and the
/// whole is its display window.
void write_exr(const std::filesystem::path& path, const Image& radiance, const std::vector<ExrLayer>& layers,
               const std::vector<std::pair<std::string, std::string>>& metadata,
               const std::optional<ExrWindow>& part = {});

/// Every channel of a file's part, over the display window, and its string attributes.
struct ExrChannels {
  int width = 0, height = 0;
  PixelRect held;                                    // the pixels that the file has; the others are 0
  std::map<std::string, std::vector<float>> planes;  // rows from the top
  std::map<std::string, std::string> metadata;       // among them the format's own "type"
};

/// A picture as it is read.
struct ExrPicture {
  Image image;                     // over the display window: black where the file has no pixels
  ExrChannels file;                // of the part that holds it
  bool cube = false;               // is it, as its attribute "envmap" says, of the six faces of a cube?
  std::vector<std::string> notes;  // what was done to it, for people
};

/// Which channels ExrPicture::file has: those of its picture, these and those of variance.* and bias.*, or all.
enum class ExrPlanes { colour, statistics, all };

/// Reads the layer of a picture that choose_colour() chooses (exr_layers.h), whichever part holds it. Colours of other
/// primaries become those of Rec. 709: those that "colorInteropID" names, else of the attribute "chromaticities", else
/// what "oiio:ColorSpace" names; a name that is not known is noted. Non-finite pixels are returned as they are. Throws
/// InputError where the file is missing, damaged, over 1 GiB in memory, deep, subsampled, of integers or of encoded
/// colours, or holds no such layer.
ExrPicture read_exr_picture(const std::filesystem::path& path, const std::string& layer = "",
                            ExrPlanes planes = ExrPlanes::all);

/// Its image alone.
Image read_exr(const std::filesystem::path& path);
/// Its file alone.
ExrChannels read_exr_channels(const std::filesystem::path& path);

/// A layer as a picture: the channels name.R, name.G and name.B, or R, G and B where the name is empty. Nothing where
/// the file lacks one of them.
std::optional<Image> layer_of(const ExrChannels& file, const std::string& name);

}  // namespace vpm
