// The value of a reflectance: a colour, or a picture.
#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "image/exr.h"
#include "image/png.h"
#include "input/sections.h"

namespace vpm {
namespace {

/// The picture under `key`, PNG or EXR by its name.
Image read_picture(TableReader& table, const std::string& key, const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension != ".png" && extension != ".exr") table.fail(key, path + ": a texture must be a .png or .exr file");
  if (extension == ".exr" && table.has("raw"))
    table.fail("raw", "'raw' is for .png files: the values of an .exr are linear", "remove it");
  const PngValues values = table.flag("raw", false) ? PngValues::linear : PngValues::srgb;
  try {
    return extension == ".png" ? read_png(path, values) : read_exr(path);
  } catch (const InputError& error) {
    table.fail(key, error.what());
  }
}

std::shared_ptr<const Texture> read_texture(TableReader table) {
  const std::string path = table.path("texture");
  const auto filter = table.choice<TextureFilter>(
      "filter", {{"bilinear", TextureFilter::bilinear}, {"nearest", TextureFilter::nearest}}, TextureFilter::bilinear);
  Image image = read_picture(table, "texture", path);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const Rgb& texel = image.pixels[i];
    const auto width = static_cast<size_t>(image.width);
    if (!(is_finite(texel) && std::min({texel.r, texel.g, texel.b}) >= 0.0f && max_channel(texel) <= 1.0f))
      table.fail("texture", path + ": the reflectance at column " + std::to_string(i % width) + ", row " +
                                std::to_string(i / width) + " is not in [0, 1]");
  }
  table.finish();
  return std::make_shared<Texture>(std::move(image), filter);
}

}  // namespace

Rgb read_reflectance(TableReader& table, MaterialPlan& plan, std::optional<Rgb> fallback) {
  const Node* node = table.find("reflectance");
  if (!node || !node->table()) return table.rgb("reflectance", kFraction, fallback);
  plan.texture = read_texture(*table.table("reflectance", "'reflectance' of " + table.title()));
  return plan.texture->mean();
}

}  // namespace vpm
