// Light of the kind "environment": a radiance, or a picture of the sky.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "vpm/base/error.h"
#include "vpm/image/hdr.h"
#include "vpm/input/sections.h"

namespace vpm {
namespace {

/// The picture of a file, .exr or .hdr by its name; what was done to it is added to `notes`.
Image read_picture(TableReader& table, const std::string& path, std::vector<std::string>& notes) {
  const std::string extension = lower_extension(path);
  const bool exr = extension == ".exr", hdr = extension == ".hdr" || extension == ".pic";
  if (!exr && !hdr) table.fail("path", path + ": a sky must be a .exr or .hdr file");
  if (hdr && table.has("layer")) table.fail("layer", "'layer' is for .exr files: a .hdr has none", "remove it");
  if (exr) {
    ExrPicture picture = read_exr_layer(table, "path", path);
    if (picture.cube)
      table.fail("path", path + ": it holds the six faces of a cube",
                 "exrenvmap, for one, makes an equirectangular picture of them");
    notes = std::move(picture.notes);
    return std::move(picture.image);
  }
  try {
    HdrPicture picture = read_hdr(path);
    notes = std::move(picture.notes);
    return std::move(picture.image);
  } catch (const InputError& error) {
    table.fail("path", error.what());
  }
}

/// Negative values become 0, and infinite ones what half floats end at. Returns how many texels had such.
size_t clamp(Image& image) {
  constexpr float kLargestHalf = 65504.0f;
  size_t clamped = 0;
  for (Rgb& texel : image.pixels) {
    const Rgb before = texel;
    for (int c = 0; c < 3; ++c)
      if (!std::isnan(texel[c]))
        texel[c] = std::isinf(texel[c]) && texel[c] > 0.0f ? kLargestHalf : std::max(0.0f, texel[c]);
    clamped += texel != before && !glm::any(glm::isnan(before));
  }
  return clamped;
}

bool clamping_helps(Image image) {
  clamp(image);
  return first_texel_outside(image, kInfinity).empty();
}

Mat3d read_sky_rotation(TableReader& table) {
  std::optional<TableReader> rotation = table.table("rotation", "'rotation' of " + table.title());
  if (!rotation) return Mat3d(1.0);
  const Vec3d axis(rotation->direction("axis"));
  const double degrees = rotation->number("degrees", kAny);
  rotation->finish();
  return Mat3d(glm::rotate(Mat4d(1.0), glm::radians(degrees), glm::normalize(axis)));
}

SkyMapping read_mapping(TableReader& table, const Image& image, std::vector<std::string>& notes) {
  const bool said = table.has("mapping");
  const auto mapping = table.choice<SkyMapping>(
      "mapping", {{"equirectangular", SkyMapping::equirectangular}, {"equal-area", SkyMapping::equal_area}},
      SkyMapping::equirectangular);
  if (mapping == SkyMapping::equal_area && image.width != image.height)
    table.fail("mapping", fmt::format("a picture of equal areas is a square, and this one has {} x {} pixels",
                                      image.width, image.height));
  if (!said && image.width != 2 * image.height)
    notes.push_back(fmt::format("it has {} x {} pixels, and equirectangular pictures are twice as wide as high{}",
                                image.width, image.height,
                                image.width == image.height ? "; a square may be mapping = \"equal-area\"" : ""));
  return mapping;
}

LightPart read_sky_picture(TableReader& table) {
  LightPart part;
  const std::string path = table.path("path");
  Image image = read_picture(table, path, part.notes);
  const float scale = table.number("scale", kPositive, 1.0f);
  const bool clamps = table.flag("clamp_negative", false);
  if (clamps)
    if (const size_t clamped = clamp(image); clamped > 0)
      part.notes.push_back(fmt::format("{} pixels were negative or infinite, and are clamped to 0 and 65504", clamped));
  for (Rgb& texel : image.pixels) texel *= scale;
  if (const std::string wrong = first_texel_outside(image, kInfinity); !wrong.empty())
    table.fail("path",
               fmt::format("{}: the radiance at {} is {}{}", path, wrong,
                           clamps ? "no number, or not finite once it is scaled" : "negative or not finite",
                           part.notes.empty() ? "" : fmt::format(" ({})", fmt::join(part.notes, "; "))),
               !clamps && clamping_helps(image)
                   ? "clamp_negative = true reads negative values as 0, and infinite ones as 65504"
                   : "mend the picture: no key replaces NaN, or what is too large");
  if (std::all_of(image.pixels.begin(), image.pixels.end(), is_black))
    table.fail("path", path + ": the whole environment is black");
  const SkyMapping mapping = read_mapping(table, image, part.notes);
  part.light = EnvironmentMap{std::make_shared<ImageEnvironment>(image.width, image.height, std::move(image.pixels),
                                                                 mapping, read_sky_rotation(table))};
  return part;
}

}  // namespace

LightPart read_environment(TableReader& table) {
  const bool map = table.has("path");
  if (table.has("radiance") == map)
    table.fail_here(table.title() + (map ? " has both 'radiance' and 'path'" : " has neither 'radiance' nor 'path'"),
                    "give one: a constant radiance (W/(m^2 sr)) or the path of a picture, .exr or .hdr");
  if (map) return read_sky_picture(table);
  LightPart part;
  part.light = ConstantEnvironment{read_emitted(table, "radiance")};
  return part;
}

}  // namespace vpm
