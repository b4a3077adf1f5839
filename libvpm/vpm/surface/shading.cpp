// The two normals of a hit: which directions pass, and what weighs flux.
#include "vpm/surface/shading.h"

#include "vpm/surface/material/kinds.h"

namespace vpm {

namespace {

/// The cosines of a direction to the two normals.
struct Cosines {
  float geometric, shading;
  bool agree() const { return geometric * shading > 0.0f; }
  float ratio() const { return std::abs(shading) / std::abs(geometric); }
};
Cosines cosines(const Hit& hit, const Vec3& direction) {
  return {glm::dot(hit.normal, direction), glm::dot(hit.shading_normal, direction)};
}

/// Does light pass from one direction of travel to the other, being transmitted or not?
bool passes(const Cosines& in, const Cosines& out, bool transmitted) {
  return in.agree() && out.agree() && (in.geometric * out.geometric > 0.0f) == transmitted;
}

/// What the hit makes of the material's scattering by the shading normal.
Scatter at_hit(const Hit& hit, const Vec3& travel, Scatter scatter) {
  if (single_normal(hit) || scatter.direction == travel) return scatter;
  const Cosines in = cosines(hit, travel), out = cosines(hit, scatter.direction);
  if (passes(in, out, scatter.transmitted))
    scatter.flux_scale = in.ratio() / out.ratio();
  else
    scatter.weight = Rgb(0.0f);
  return scatter;
}

}  // namespace

Scatter sample_scatter(const Material& material, const Hit& hit, const Vec3& travel, float u_choice, const Vec2& u) {
  return at_hit(hit, travel, sample_scatter(material, hit.shading_normal, travel, u_choice, u));
}

Scatter scatter_into(const Material& material, const Hit& hit, const Vec3& travel, const Vec3& direction) {
  const Vec3& normal = hit.shading_normal;
  const bool transmitted = glm::dot(normal, travel) * glm::dot(normal, direction) > 0.0f;
  const ScatterValue value = scatter_value(material, normal, travel, direction);
  return at_hit(hit, travel, scattered(direction, value, transmitted));
}

ScatterValue scatter_value(const Material& material, const Hit& hit, const Vec3& travel, const Vec3& direction) {
  const ScatterValue scattered = scatter_value(material, hit.shading_normal, travel, direction);
  if (single_normal(hit)) return scattered;
  const Cosines in = cosines(hit, travel), out = cosines(hit, direction);
  const bool transmitted = in.shading * out.shading > 0.0f;
  return passes(in, out, transmitted) ? scattered : ScatterValue{};
}

float shading_irradiance_scale(const Hit& hit, const Vec3& travel) {
  if (single_normal(hit)) return 1.0f;
  const Cosines in = cosines(hit, travel);
  return in.agree() ? in.ratio() : 0.0f;
}

}  // namespace vpm
