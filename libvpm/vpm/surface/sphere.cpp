// Rays against spheres, in double precision: robust for spheres that are far, tiny or huge, from inside and outside.
#include "vpm/surface/sphere.h"

#include <algorithm>

#include "vpm/base/warp.h"

namespace vpm {

double intersect_sphere(const SphereShape& sphere, const Ray& ray, float t_min) {
  // The quadratic a t^2 - 2 b t + c = 0 [Haines2019, sec. 7.2]: the discriminant from the distance of the centre to the
  // ray, which does not cancel for far spheres, and the smaller root without a difference of near equals.
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const Vec3d from_centre = Vec3d(ray.origin) - Vec3d(sphere.centre);
  const Vec3d d(ray.direction);
  const double radius = sphere.radius;
  const double a = glm::dot(d, d);
  const double b = -glm::dot(from_centre, d);
  const Vec3d nearest = from_centre + (b / a) * d;
  const double discriminant = a * (radius * radius - glm::dot(nearest, nearest));
  if (!(discriminant >= 0.0)) return kNone;
  const double q = b + std::copysign(std::sqrt(discriminant), b);
  if (q == 0.0) return kNone;
  const double distance = glm::length(from_centre);
  const double c = (distance - radius) * (distance + radius);
  const double t0 = b > 0.0 ? c / q : q / a;
  const double t1 = b > 0.0 ? q / a : c / q;
  if (t0 >= t_min) return t0;
  return t1 >= t_min ? t1 : kNone;
}

Vec3 point_on(const SphereShape& sphere, const Vec3d& normal) {
  return Vec3(Vec3d(sphere.centre) + sphere.radius / glm::length(normal) * normal);
}

Vec3d sphere_normal(const SphereShape& sphere, const Ray& ray, double t) {
  return glm::normalize((Vec3d(ray.origin) - Vec3d(sphere.centre)) + t * Vec3d(ray.direction));
}

Vec2 sphere_uv(const Vec3& normal) {
  const float turn = turns_of(normal.x, normal.z);
  const double rise = std::asin(std::clamp(double{normal.y}, -1.0, 1.0)) / kPiD;
  return {turn < 0.0f ? turn + 1.0f : turn, static_cast<float>(0.5 + rise)};
}

}  // namespace vpm
