// The section [[lights]].
#include <cmath>

#include "vpm/input/sections.h"

namespace vpm {

Rgb read_emitted(TableReader& table, const std::string& key) {
  const Rgb value = table.rgb(key, kNotNegative);
  if (is_black(value)) table.fail(key, table.title() + " emits nothing", "make '" + key + "' positive, or remove it");
  return value;
}

namespace {

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

template <Light (*read)(TableReader&)>
LightPart part_of(TableReader& table) {
  LightPart part;
  part.light = read(table);
  return part;
}

}  // namespace

std::vector<LightPlan> read_lights(std::vector<TableReader>& tables) {
  using Reader = LightPart (*)(TableReader&);
  const std::vector<std::pair<std::string, Reader>> kinds = {{"point", part_of<read_point>},
                                                             {"spot", part_of<read_spot>},
                                                             {"beam", part_of<read_beam>},
                                                             {"directional", part_of<read_directional>},
                                                             {"environment", read_environment}};
  std::vector<LightPlan> lights;
  for (TableReader& table : tables) {
    const std::string name = table.string("name", "");
    const Reader read = table.choice<Reader>("type", kinds);
    LightPart part = read(table);
    part.name = name;
    lights.push_back({std::move(part), table});
    table.finish();
  }
  return lights;
}

}  // namespace vpm
