// The value of a reflectance, a colour or a picture; what the values of pictures may be.
#include <algorithm>

#include "vpm/base/error.h"
#include "vpm/image/png.h"
#include "vpm/input/sections.h"

namespace vpm {
namespace {

/// The picture under `key`, PNG or EXR by its name.
Image read_picture(TableReader& table, const std::string& key, const std::string& path,
                   std::vector<std::string>& notes) {
  const std::string extension = lower_extension(path);
  if (extension != ".png" && extension != ".exr") table.fail(key, path + ": a texture must be a .png or .exr file");
  if (extension == ".exr" && table.has("raw"))
    table.fail("raw", "'raw' is for .png files: the values of an .exr are linear", "remove it");
  if (extension == ".png" && table.has("layer"))
    table.fail("layer", "'layer' is for .exr files: a .png has none", "remove it");
  if (extension == ".exr") {
    ExrPicture picture = read_exr_layer(table, key, path);
    notes = std::move(picture.notes);
    return std::move(picture.image);
  }
  try {
    return read_png(path, table.flag("raw", false) ? PngValues::linear : PngValues::srgb);
  } catch (const InputError& error) {
    table.fail(key, error.what());
  }
}

std::shared_ptr<const Texture> read_texture(TableReader table, std::vector<std::string>& notes) {
  const std::string path = table.path("texture");
  const auto filter = table.choice<TextureFilter>(
      "filter", {{"bilinear", TextureFilter::bilinear}, {"nearest", TextureFilter::nearest}}, TextureFilter::bilinear);
  Image image = read_picture(table, "texture", path, notes);
  const std::string wrong = first_texel_outside(image, 1.0f);
  if (!wrong.empty()) table.fail("texture", path + ": the reflectance at " + wrong + " is not in [0, 1]");
  table.finish();
  return std::make_shared<Texture>(std::move(image), filter);
}

}  // namespace

ExrPicture read_exr_layer(TableReader& table, const std::string& key, const std::string& path) {
  const std::string layer = table.string("layer", "");
  try {
    return read_exr_picture(path, layer, ExrPlanes::colour);
  } catch (const InputError& error) {
    table.fail(key, error.what());
  }
}

std::string first_texel_outside(const Image& image, float largest) {
  const auto inside = [largest](const Rgb& texel) {
    return is_finite(texel) && std::min({texel.r, texel.g, texel.b}) >= 0.0f && max_channel(texel) <= largest;
  };
  const auto found = std::find_if_not(image.pixels.begin(), image.pixels.end(), inside);
  if (found == image.pixels.end()) return "";
  const auto i = static_cast<size_t>(found - image.pixels.begin()), width = static_cast<size_t>(image.width);
  return "column " + std::to_string(i % width) + ", row " + std::to_string(i / width);
}

Rgb read_reflectance(TableReader& table, MaterialPart& part, std::optional<Rgb> fallback) {
  const Node* node = table.find("reflectance");
  if (!node || !node->table()) return table.rgb("reflectance", kFraction, fallback);
  part.texture = read_texture(*table.table("reflectance", "'reflectance' of " + table.title()), part.notes);
  return part.texture->mean();
}

}  // namespace vpm
