// How far a ray's origin has to stand off the surface it leaves, from bounds on the rounding of the intersections.
#include "vpm/surface/geometry.h"

namespace vpm {

namespace {
constexpr float kUlp = 0x1p-23f;     // spacing of floats in [1, 2): at most twice the relative rounding error
constexpr double kNeedle = 0x1p-10;  // of its length, the farthest a triangle makes rays stand off for its shape
}  // namespace

Vec3 leave_surface_at(const Vec3& position, const Vec3& normal, const Vec3& direction, float slack) {
  // The coordinates were rounded when the position was stored and are again here: half a unit each. Along the normal
  // that is at most sum |n_i| |p_i|; four units, so that two points either side of a surface keep their order.
  const float rounding = 4.0f * kUlp * glm::dot(glm::abs(normal), glm::abs(position));
  const float offset = rounding + slack;
  return position + (glm::dot(normal, direction) < 0.0f ? -offset : offset) * normal;
}

Vec3 leave_surface(const Hit& hit, const Vec3& direction) {
  return leave_surface_at(hit.position, hit.normal, direction, hit.slack);
}

Vec3 leave_surfaces(const Encounter& met, const Vec3& direction) {
  Vec3 beyond = leave_surface(met.hits[0], direction);
  for (int i = 1; i < met.count; ++i) {
    const Vec3 other = leave_surface(met.hits[i], direction);
    if (glm::dot(other - beyond, direction) > 0.0f) beyond = other;
  }
  return beyond;
}

float flat_slack(const Vec3& normal, const Vec3& reach, double twice_area) {
  // Embree takes the vertices relative to the ray's origin, v with |v_i| <= reach_i, and compares dot(v, N) with 0, N
  // the cross product of two edges. Rounding v_i by its unit displaces the plane by up to sum |n_i| reach_i units;
  // rounding the products of edges in N, by multiples of reach_x reach_y reach_z / |N| units. Both vanish for planes
  // across an axis. Six of each: of 1.5e7 rays off triangles of all scales and shapes, two of each let 48 meet theirs
  // again, four none. The last term keeps the origin off a plane through 0.
  const Vec3d r(reach);
  const double longest = std::max(r.x, std::max(r.y, r.z));
  const double vertices = glm::dot(glm::abs(Vec3d(normal)), r);
  const double product = std::min(6.0 * kUlp * r.x * r.y * r.z / twice_area, kNeedle * longest);
  return static_cast<float>(6.0 * kUlp * vertices + product + kUlp * kUlp * longest);
}

float disc_slack(const DiscShape& disc) {
  // The intersection is in double: all that is left is to keep the origin off a plane through 0.
  return 0x1p-40f * disc.radius;
}

bool stands_at(const Hit& hit, const Ray& ray, float distance) {
  // The direction's rounding moves the far end of the ray sideways, and that of coordinates both its ends; over the
  // cosine it is the way along the ray. As in coincidence of hits, eight units.
  const float rounding = 8.0f * kUlp * (hit.t + glm::length(hit.position)) + hit.slack;
  return (distance - hit.t) * std::abs(glm::dot(hit.normal, ray.direction)) <= rounding;
}

float sphere_slack(const SphereShape& sphere) {
  // The intersection is in double, but the normal has float's direction: an origin that leaves outward by the normal
  // may approach the sphere, by the square of its rounding.
  return 0x1p-40f * sphere.radius;
}

}  // namespace vpm
