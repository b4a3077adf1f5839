// Parallel light: a beam from a disc, and light from infinity.
#include "vpm/base/warp.h"
#include "vpm/light/kinds.h"

namespace vpm {

Vec3 point_on_disc(const Vec3& centre, const Vec3& axis, float radius, const Vec2& u) {
  const Vec2 d = radius * uniform_disc(u);
  Vec3 s, t;
  make_frame(axis, s, t);
  return centre + d.x * s + d.y * t;
}

Rgb power_of(const BeamLight& light, const Box&) { return light.power; }

Emission emit_from(const BeamLight& light, const Box&, const EmissionNumbers& u) {
  return {Ray{point_on_disc(light.position, light.direction, light.radius, u.place), light.direction}, light.power};
}

std::optional<Incident> incident_from(const BeamLight& light, const Vec3& point, Rng&) {
  const Vec3 from_disc = point - light.position;
  const float ahead = glm::dot(from_disc, light.direction);
  if (!(ahead > 0.0f) || glm::length(from_disc - ahead * light.direction) > light.radius) return std::nullopt;
  return Incident{-light.direction, ahead, light.power / (kPi * light.radius * light.radius), 0.0f};
}

Rgb power_of(const DirectionalLight& light, const Box& scene) {
  return static_cast<float>(area_across(scene, light.direction)) * light.irradiance;
}

Emission emit_from(const DirectionalLight& light, const Box& scene, const EmissionNumbers& u) {
  return {ray_into(scene, light.direction, u), power_of(light, scene)};
}

std::optional<Incident> incident_from(const DirectionalLight& light, const Vec3&, Rng&) {
  return Incident{-light.direction, kInfinity, light.irradiance, 0.0f};
}

LightPlace place_of(const BeamLight& light) {
  return {{light.position - light.radius, light.position + light.radius}, light.position};
}

}  // namespace vpm
