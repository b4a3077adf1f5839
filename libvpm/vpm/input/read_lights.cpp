// The section [[lights]].
#include <algorithm>

#include "vpm/base/error.h"
#include "vpm/image/exr.h"
#include "vpm/input/sections.h"

namespace vpm {
namespace {

Rgb read_emitted(TableReader& table, const std::string& key) {
  const Rgb value = table.rgb(key, kNotNegative);
  if (is_black(value))
    table.fail(key, table.title() + " emits nothing", "make '" + key + "' positive, or remove the light");
  return value;
}

/// Intensity in W/sr, given as such, or as the power in W that leaves through `solid_angle`, sr of full intensity.
Rgb read_intensity(TableReader& table, float solid_angle) {
  const bool power = table.has("power");
  if (table.has("intensity") == power)
    table.fail_here(
        table.title() + (power ? " has both 'intensity' and 'power'" : " has neither 'intensity' nor 'power'"),
        "give one: intensity (W/sr) or power (W)");
  return power ? read_emitted(table, "power") / solid_angle : read_emitted(table, "intensity");
}

Light read_point(TableReader& table) { return PointLight{table.vector("position"), read_intensity(table, 4.0f * kPi)}; }

Vec3 read_aim(TableReader& table, const Vec3& position) {
  const bool target = table.has("target");
  if (table.has("direction") == target)
    table.fail_here(
        table.title() + (target ? " has both 'direction' and 'target'" : " has neither 'direction' nor 'target'"),
        "give one: the direction of travel, or a target point");
  if (!target) return table.direction("direction");
  const Vec3d towards = Vec3d(table.vector("target")) - Vec3d(position);
  if (glm::length(towards) == 0.0) table.fail("target", "the target of " + table.title() + " is its position");
  return Vec3(glm::normalize(towards));
}

Light read_spot(TableReader& table) {
  SpotLight spot;
  spot.position = table.vector("position");
  spot.direction = read_aim(table, spot.position);
  const float outer = table.number("outer_angle", {0.0, 180.0, true, true});
  const float inner = table.number("inner_angle", {0.0, 180.0, false, true}, 0.0f);
  if (inner > outer) table.fail("inner_angle", "'inner_angle' of " + table.title() + " must not exceed 'outer_angle'");
  spot.cos_inner = static_cast<float>(std::cos(glm::radians(static_cast<double>(inner))));
  spot.cos_outer = static_cast<float>(std::cos(glm::radians(static_cast<double>(outer))));
  const float solid_angle = kPi * ((1.0f - spot.cos_inner) + (1.0f - spot.cos_outer));  // smoothstep's mean is 1/2
  if (!(solid_angle > 0.0f))
    table.fail("outer_angle", "'outer_angle' of " + table.title() + " is too narrow", "use a beam light");
  spot.intensity = read_intensity(table, solid_angle);
  return spot;
}

Light read_beam(TableReader& table) {
  BeamLight beam;
  beam.position = table.vector("position");
  beam.direction = read_aim(table, beam.position);
  beam.radius = table.number("radius", kPositive);
  beam.power = read_emitted(table, "power");
  return beam;
}

Light read_directional(TableReader& table) {
  return DirectionalLight{table.direction("direction"), read_emitted(table, "irradiance")};
}

Light read_environment_map(TableReader& table) {
  const std::string path = table.path("path");
  const float scale = table.number("scale", kPositive, 1.0f);
  Image image;
  try {
    image = read_exr(path);
  } catch (const InputError& error) {
    table.fail("path", error.what());
  }
  for (Rgb& texel : image.pixels) texel *= scale;
  const std::string wrong = first_texel_outside(image, kInfinity);
  if (!wrong.empty()) table.fail("path", path + ": the radiance at " + wrong + " is negative or not finite");
  if (std::all_of(image.pixels.begin(), image.pixels.end(), is_black))
    table.fail("path", path + ": the whole environment is black");
  return EnvironmentMap{std::make_shared<ImageEnvironment>(image.width, image.height, std::move(image.pixels))};
}

Light read_environment(TableReader& table) {
  const bool map = table.has("path");
  if (table.has("radiance") == map)
    table.fail_here(table.title() + (map ? " has both 'radiance' and 'path'" : " has neither 'radiance' nor 'path'"),
                    "give one: a constant radiance (W/(m^2 sr)) or the path of an equirectangular EXR");
  return map ? read_environment_map(table) : ConstantEnvironment{read_emitted(table, "radiance")};
}

}  // namespace

std::vector<LightPlan> read_lights(std::vector<TableReader>& tables) {
  using Reader = Light (*)(TableReader&);
  const std::vector<std::pair<std::string, Reader>> kinds = {{"point", read_point},
                                                             {"spot", read_spot},
                                                             {"beam", read_beam},
                                                             {"directional", read_directional},
                                                             {"environment", read_environment}};
  std::vector<LightPlan> lights;
  for (TableReader& table : tables) {
    const std::string name = table.string("name", "");
    const Reader read = table.choice<Reader>("type", kinds);
    lights.push_back({{name, read(table)}, table});
    table.finish();
  }
  return lights;
}

}  // namespace vpm
