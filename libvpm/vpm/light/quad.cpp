// A parallelogram that emits the same radiance from every point of its front.
#include "vpm/base/warp.h"
#include "vpm/light/kinds.h"

namespace vpm {

namespace {

/// cross(edge_u, edge_v): its length is the area, m^2.
Vec3d area_vector(const QuadLight& light) { return glm::cross(Vec3d(light.edge_u), Vec3d(light.edge_v)); }

float area_of(const QuadLight& light) { return static_cast<float>(glm::length(area_vector(light))); }

Vec3 uniform_point(const QuadLight& light, const Vec2& u) {
  return Vec3(Vec3d(light.corner) + double{u.x} * Vec3d(light.edge_u) + double{u.y} * Vec3d(light.edge_v));
}

/// The largest distance along each axis from `p` to a corner, m.
Vec3 reach_from(const QuadLight& light, const Vec3& p) {
  const Vec3 a = light.corner - p, b = a + light.edge_u, c = a + light.edge_v, d = b + light.edge_v;
  return glm::max(glm::max(glm::abs(a), glm::abs(b)), glm::max(glm::abs(c), glm::abs(d)));
}

}  // namespace

Rgb power_of(const QuadLight& light, const Box&) { return kPi * area_of(light) * light.radiance; }

Emission emit_from(const QuadLight& light, const Box& scene, const EmissionNumbers& u) {
  const Vec3d across = area_vector(light);
  const Vec3 normal(glm::normalize(across));
  const Vec3 p = uniform_point(light, u.place);
  const Vec3 direction = cosine_hemisphere(normal, u.direction);
  const float slack = flat_slack(normal, reach_from(light, p), glm::length(across));
  return {Ray{leave_surface_at(p, normal, direction, slack), direction}, power_of(light, scene), normal};
}

std::optional<Incident> incident_from(const QuadLight& light, const Vec3& point, Rng& rng) {
  return incident_by_area(light.radiance, draw_place(light, rng), point);
}

LightPoint draw_place(const QuadLight& light, Rng& rng) {
  return {uniform_point(light, rng.uniform2()), Vec3(glm::normalize(area_vector(light))), area_of(light)};
}

float pdf_of(const QuadLight& light, const Vec3&, const SeenLight& seen) { return pdf_by_area(area_of(light), seen); }

LightPlace place_of(const QuadLight& light) {
  Box box;
  for (const Vec3& p : {Vec3(0.0f), light.edge_u, light.edge_v, light.edge_u + light.edge_v}) box.add(light.corner + p);
  const Vec3d across = area_vector(light);
  const Vec3 normal(glm::normalize(across)), middle = uniform_point(light, Vec2(0.5f));
  const float slack = flat_slack(normal, reach_from(light, middle), glm::length(across));
  return {box, leave_surface_at(middle, normal, normal, slack)};
}

}  // namespace vpm
