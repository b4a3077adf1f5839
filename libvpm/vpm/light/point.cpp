// Light from a point: to all sides, or in a cone with a soft edge.
#include "vpm/base/warp.h"
#include "vpm/light/kinds.h"

namespace vpm {

namespace {

/// 3 x^2 - 2 x^3, from 0 at x = 0 to 1 at x = 1; its integral is 1/2.
float smoothstep(float x) { return x * x * (3.0f - 2.0f * x); }

/// x in [0, 1] with density 2 smoothstep(x). A uniform x is kept with probability smoothstep(x); those not kept have
/// density 2 smoothstep(1 - x), so that mirroring them yields the wanted density again and nothing is rejected.
float sample_smoothstep(const Vec2& u) { return u.y < smoothstep(u.x) ? u.x : 1.0f - u.x; }

/// Part of the intensity at a cosine to the axis.
float falloff(const SpotLight& light, float cosine) {
  if (cosine >= light.cos_inner) return 1.0f;
  if (cosine <= light.cos_outer) return 0.0f;
  return smoothstep((cosine - light.cos_outer) / (light.cos_inner - light.cos_outer));
}

/// The integrals of the falloff over the cosine: within the inner cone, and between the cones.
struct SpotParts {
  float inner = 0.0f, rim = 0.0f;
};
SpotParts spot_parts(const SpotLight& light) {
  return {1.0f - light.cos_inner, 0.5f * (light.cos_inner - light.cos_outer)};
}

/// A uniformly random azimuth and the given 1 - cosine about the spot's axis.
Vec3 spot_direction(const SpotLight& light, const EmissionNumbers& u) {
  const SpotParts parts = spot_parts(light);
  const bool within = u.choice * (parts.inner + parts.rim) < parts.inner;
  const float away = within ? u.direction.x * parts.inner
                            : parts.inner + 2.0f * parts.rim * (1.0f - sample_smoothstep({u.direction.x, u.place.x}));
  return direction_about(light.direction, away, 2.0f * kPi * u.direction.y);
}

/// The direction, distance and geometry of a point light; irradiance for the given intensity.
std::optional<Incident> from_position(const Vec3& position, const Vec3& point, const Rgb& intensity) {
  const Vec3 towards = position - point;
  const float square = glm::dot(towards, towards);
  if (!(square > 0.0f)) return std::nullopt;
  const float distance = std::sqrt(square);
  return Incident{towards / distance, distance, intensity / square, 0.0f};
}

}  // namespace

Rgb power_of(const PointLight& light, const Box&) { return 4.0f * kPi * light.intensity; }

Emission emit_from(const PointLight& light, const Box& scene, const EmissionNumbers& u) {
  return {Ray{light.position, uniform_sphere(u.direction)}, power_of(light, scene)};
}

std::optional<Incident> incident_from(const PointLight& light, const Vec3& point, Rng&) {
  return from_position(light.position, point, light.intensity);
}

Rgb power_of(const SpotLight& light, const Box&) {
  const SpotParts parts = spot_parts(light);
  return 2.0f * kPi * (parts.inner + parts.rim) * light.intensity;
}

double spot_density(const SpotLight& light, const Vec3& travel) {
  const SpotParts parts = spot_parts(light);
  return falloff(light, glm::dot(travel, light.direction)) / (2.0 * kPiD * (parts.inner + parts.rim));
}

Emission emit_from(const SpotLight& light, const Box& scene, const EmissionNumbers& u) {
  return {Ray{light.position, spot_direction(light, u)}, power_of(light, scene)};
}

std::optional<Incident> incident_from(const SpotLight& light, const Vec3& point, Rng&) {
  std::optional<Incident> in = from_position(light.position, point, light.intensity);
  if (!in) return std::nullopt;
  const float part = falloff(light, -glm::dot(in->direction, light.direction));
  if (part == 0.0f) return std::nullopt;
  in->irradiance *= part;
  return in;
}

LightPlace place_of(const PointLight& light) { return {{light.position, light.position}, light.position}; }

LightPlace place_of(const SpotLight& light) { return {{light.position, light.position}, light.position}; }

}  // namespace vpm
