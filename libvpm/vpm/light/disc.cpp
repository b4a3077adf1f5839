// A disc that emits the same radiance from every point of its front.
#include "vpm/surface/disc.h"
#include "vpm/base/warp.h"
#include "vpm/light/kinds.h"

namespace vpm {

namespace {

float area_of(const DiscLight& light) { return kPi * light.radius * light.radius; }

/// In the disc's plane to the rounding of its coordinates, which that of the frame about the normal would exceed.
Vec3 uniform_point(const DiscLight& light, const Vec2& u) {
  const Vec3d from_centre(point_on_disc(Vec3(0.0f), light.normal, light.radius, u)), normal(light.normal);
  const double off = glm::dot(from_centre, normal) / glm::dot(normal, normal);
  return Vec3(Vec3d(light.centre) + from_centre - off * normal);
}

}  // namespace

Rgb power_of(const DiscLight& light, const Box&) { return kPi * area_of(light) * light.radiance; }

Emission emit_from(const DiscLight& light, const Box& scene, const EmissionNumbers& u) {
  const Vec3 p = uniform_point(light, u.place);
  const Vec3 direction = cosine_hemisphere(light.normal, u.direction);
  const float slack = disc_slack({light.centre, light.normal, light.radius});
  return {Ray{leave_surface_at(p, light.normal, direction, slack), direction}, power_of(light, scene), light.normal};
}

std::optional<Incident> incident_from(const DiscLight& light, const Vec3& point, Rng& rng) {
  return incident_by_area(light.radiance, draw_place(light, rng), point);
}

LightPoint draw_place(const DiscLight& light, Rng& rng) {
  return {uniform_point(light, rng.uniform2()), light.normal, area_of(light)};
}

float pdf_of(const DiscLight& light, const Vec3&, const SeenLight& seen) { return pdf_by_area(area_of(light), seen); }

LightPlace place_of(const DiscLight& light) {
  const DiscShape shape{light.centre, light.normal, light.radius};
  return {bounds_of(shape), leave_surface_at(light.centre, light.normal, light.normal, disc_slack(shape))};
}

}  // namespace vpm
