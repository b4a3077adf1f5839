// A sphere that emits the same radiance from every point of its outside.
#include "vpm/base/warp.h"
#include "vpm/light/kinds.h"

namespace vpm {

namespace {

/// 1 - cosine of the cone in which the sphere is seen from a point at that distance from its centre; 0 from inside.
float cone_of(const SphereLight& light, double distance) {
  const double sine = light.radius / distance;
  return sine < 1.0 ? static_cast<float>(sine * sine / (1.0 + std::sqrt((1.0 - sine) * (1.0 + sine)))) : 0.0f;
}

}  // namespace

Rgb power_of(const SphereLight& light, const Box&) {
  return 4.0f * kPi * kPi * light.radius * light.radius * light.radiance;
}

Emission emit_from(const SphereLight& light, const Box& scene, const EmissionNumbers& u) {
  const Vec3 normal = uniform_sphere(u.place);
  const Vec3 direction = cosine_hemisphere(normal, u.direction);
  const SphereShape shape{light.centre, light.radius};
  const Vec3 origin = leave_surface_at(point_on(shape, normal), normal, direction, sphere_slack(shape));
  return {Ray{origin, direction}, power_of(light, scene), normal};
}

std::optional<Incident> incident_from(const SphereLight& light, const Vec3& point, Rng& rng) {
  const Vec3d to_centre = Vec3d(light.centre) - Vec3d(point);
  const double distance = glm::length(to_centre);
  const float away = cone_of(light, distance);
  if (away == 0.0f) return std::nullopt;
  const Vec3 direction = uniform_cone(Vec3(to_centre / distance), away, rng.uniform2());
  const double along = glm::dot(to_centre, Vec3d(direction));
  const Vec3d off_axis = to_centre - along * Vec3d(direction);
  // At the cone's rim rounding may carry the direction past the sphere: there the chord is 0.
  const double half_chord =
      std::sqrt(std::max(0.0, double{light.radius} * light.radius - glm::dot(off_axis, off_axis)));
  const float pdf = 1.0f / (2.0f * kPi * away);
  const Vec3 normal(glm::normalize((along - half_chord) * Vec3d(direction) - to_centre));
  return Incident{direction, static_cast<float>(along - half_chord), light.radiance / pdf, pdf, normal};
}

float pdf_of(const SphereLight& light, const Vec3& point, const SeenLight&) {
  const float away = cone_of(light, glm::length(Vec3d(light.centre) - Vec3d(point)));
  return away > 0.0f ? 1.0f / (2.0f * kPi * away) : 0.0f;
}

LightPlace place_of(const SphereLight& light) {
  const SphereShape shape{light.centre, light.radius};
  const Vec3 normal = glm::normalize(Vec3(0.5470f, 0.7316f, 0.4071f));  // of no symmetry, away from others' edges
  return {{light.centre - light.radius, light.centre + light.radius},
          leave_surface_at(point_on(shape, normal), normal, normal, sphere_slack(shape))};
}

}  // namespace vpm
