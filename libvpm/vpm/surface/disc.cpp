// Rays against flat discs, in double precision.
#include "vpm/surface/disc.h"

namespace vpm {

double intersect_disc(const DiscShape& disc, const Ray& ray, float t_min) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const Vec3d normal(disc.normal);
  const double t = glm::dot(Vec3d(disc.centre) - Vec3d(ray.origin), normal) / glm::dot(Vec3d(ray.direction), normal);
  if (!(t >= t_min && t < kNone)) return kNone;  // NaN: a ray within the plane
  const Vec3d from_centre = disc_point(disc, ray, t) - Vec3d(disc.centre);
  return glm::dot(from_centre, from_centre) <= double{disc.radius} * disc.radius ? t : kNone;
}

Vec3d disc_point(const DiscShape& disc, const Ray& ray, double t) {
  const Vec3d normal(disc.normal);
  const Vec3d from_centre = (Vec3d(ray.origin) - Vec3d(disc.centre)) + t * Vec3d(ray.direction);
  return Vec3d(disc.centre) + from_centre - glm::dot(from_centre, normal) / glm::dot(normal, normal) * normal;
}

Box bounds_of(const DiscShape& disc) {
  const Vec3 half = disc.radius * glm::sqrt(glm::max(Vec3(0.0f), 1.0f - disc.normal * disc.normal));
  return {disc.centre - half, disc.centre + half};
}

}  // namespace vpm
