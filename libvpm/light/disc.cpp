// A disc that emits the same radiance from every point of its front.
#include "base/warp.h"
#include "light/kinds.h"

namespace vpm {

namespace {

float area_of(const DiscLight& light) { return kPi * light.radius * light.radius; }

Vec3 uniform_point(const DiscLight& light, Rng& rng) {
  return point_on_disc(light.centre, light.normal, light.radius, rng.uniform2());
}

}  // namespace

Rgb power_of(const DiscLight& light, const Box&) { return kPi * area_of(light) * light.radiance; }

Emission emit_from(const DiscLight& light, const Box& scene, Rng& rng) {
  const Vec3 p = uniform_point(light, rng);
  const Vec3 direction = cosine_hemisphere(light.normal, rng.uniform2());
  const float slack = disc_slack({light.centre, light.normal, light.radius});
  return {Ray{leave_surface_at(p, light.normal, direction, slack), direction}, power_of(light, scene)};
}

std::optional<Incident> incident_from(const DiscLight& light, const Vec3& point, Rng& rng) {
  return incident_by_area(light.radiance, uniform_point(light, rng), light.normal, area_of(light), point);
}

float pdf_of(const DiscLight& light, const Vec3&, const SeenLight& seen) { return pdf_by_area(area_of(light), seen); }

}  // namespace vpm
