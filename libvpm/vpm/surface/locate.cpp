// Hits of meshes, spheres and discs, in double precision. Spheres may be far, tiny or huge, and be met from inside and
// outside.
#include "vpm/surface/locate.h"

#include <algorithm>
#include <cmath>

#include "vpm/base/warp.h"
#include "vpm/surface/mesh.h"

namespace vpm {

double intersect_sphere(const SphereShape& sphere, const Ray& ray, float t_min) {
  // The quadratic a t^2 - 2 b t + c = 0 [Haines2019, sec. 7.2]: the discriminant from the distance of the center to the
  // ray, which does not cancel for far spheres, and the smaller root without a difference of near equals.
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const Vec3d from_center = Vec3d(ray.origin) - Vec3d(sphere.center);
  const Vec3d d(ray.direction);
  const double radius = sphere.radius;
  const double a = glm::dot(d, d);
  const double b = -glm::dot(from_center, d);
  const Vec3d nearest = from_center + (b / a) * d;
  const double discriminant = a * (radius * radius - glm::dot(nearest, nearest));
  if (!(discriminant >= 0.0)) return kNone;
  const double q = b + std::copysign(std::sqrt(discriminant), b);
  if (q == 0.0) return kNone;
  const double distance = glm::length(from_center);
  const double c = (distance - radius) * (distance + radius);
  const double t0 = b > 0.0 ? c / q : q / a;
  const double t1 = b > 0.0 ? q / a : c / q;
  if (t0 >= t_min) return t0;
  return t1 >= t_min ? t1 : kNone;
}

Vec3 point_on(const SphereShape& sphere, const Vec3d& normal) {
  return Vec3(Vec3d(sphere.center) + sphere.radius / glm::length(normal) * normal);
}

Vec3d sphere_normal(const SphereShape& sphere, const Ray& ray, double t) {
  return glm::normalize((Vec3d(ray.origin) - Vec3d(sphere.center)) + t * Vec3d(ray.direction));
}

Vec2 sphere_uv(const Vec3& normal) {
  const float turn = turns_of(normal.x, normal.z);
  const double rise = std::asin(std::clamp(double{normal.y}, -1.0, 1.0)) / kPiD;
  return {turn < 0.0f ? turn + 1.0f : turn, static_cast<float>(0.5 + rise)};
}

double intersect_disc(const DiscShape& disc, const Ray& ray, float t_min) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const Vec3d normal(disc.normal);
  const double t = glm::dot(Vec3d(disc.center) - Vec3d(ray.origin), normal) / glm::dot(Vec3d(ray.direction), normal);
  if (!(t >= t_min && t < kNone)) return kNone;  // NaN: a ray within the plane
  const Vec3d from_center = disc_point(disc, ray, t) - Vec3d(disc.center);
  return glm::dot(from_center, from_center) <= double{disc.radius} * disc.radius ? t : kNone;
}

Vec3d disc_point(const DiscShape& disc, const Ray& ray, double t) {
  const Vec3d normal(disc.normal);
  const Vec3d from_center = (Vec3d(ray.origin) - Vec3d(disc.center)) + t * Vec3d(ray.direction);
  return Vec3d(disc.center) + from_center - glm::dot(from_center, normal) / glm::dot(normal, normal) * normal;
}

Box bounds_of(const DiscShape& disc) {
  const Vec3 half = disc.radius * glm::sqrt(glm::max(Vec3(0.0f), 1.0f - disc.normal * disc.normal));
  return {disc.center - half, disc.center + half};
}

namespace {

/// The normal for shading, on the side of the geometric one.
Vec3 shading_normal(const MeshShape& mesh, const glm::uvec3& v, const Hit& hit) {
  if (mesh.normals.empty()) return hit.normal;
  const Vec3d sum(interpolated(mesh.normals, v, hit.barycentric));
  const double length = glm::length(sum);
  if (length == 0.0) return hit.normal;
  const Vec3 normal(sum / length);
  return glm::dot(normal, hit.normal) < 0.0f ? -normal : normal;
}

/// All that follows from the point of a triangle of this plane and area, and from its barycentric coordinates.
void fill_in(const MeshShape& mesh, uint32_t triangle, double twice_area, const Vec3d& position,
             const Vec2& barycentric, Hit& hit) {
  const glm::uvec3& v = mesh.triangles[triangle];
  const Vec3 &a = mesh.positions[v.x], &b = mesh.positions[v.y], &c = mesh.positions[v.z];
  hit.position = Vec3(position);
  hit.normal = Vec3(mesh.planes[triangle].normal);
  const Vec3& p = hit.position;
  const Vec3 reach = glm::max(glm::max(glm::abs(a - p), glm::abs(b - p)), glm::abs(c - p));
  hit.slack = flat_slack(hit.normal, reach, twice_area);
  hit.triangle = triangle;
  hit.barycentric = barycentric;
  hit.shading_normal = shading_normal(mesh, v, hit);
}

}  // namespace

Crossing crossing(const MeshShape& mesh, uint32_t triangle, const Ray& ray) {
  const TrianglePlane& plane = mesh.planes[triangle];
  const double cosine = glm::dot(plane.normal, Vec3d(ray.direction)), inverse_cosine = 1.0 / cosine;
  if (std::abs(cosine) < 1e-14) return {};
  return {(plane.offset - glm::dot(plane.normal, Vec3d(ray.origin))) * inverse_cosine, inverse_cosine};
}

Crossing crossing(const SphereShape& sphere, const Ray& ray) { return {intersect_sphere(sphere, ray, kMinT)}; }

Crossing crossing(const DiscShape& disc, const Ray& ray) {
  return {intersect_disc(disc, ray, kMinT), 1.0 / double{glm::dot(disc.normal, ray.direction)}};
}

void locate(const MeshShape& mesh, uint32_t triangle, const Ray& ray, const Crossing& met, Hit& hit) {
  const glm::uvec3& v = mesh.triangles[triangle];
  const TrianglePlane& plane = mesh.planes[triangle];
  const Vec3d a(mesh.positions[v.x]), ab = Vec3d(mesh.positions[v.y]) - a, ac = Vec3d(mesh.positions[v.z]) - a;
  const Vec3d origin(ray.origin), d(ray.direction), across = glm::cross(origin - a, d);
  const double twice_area = glm::length(glm::cross(ab, ac)), scale = met.inverse_cosine / twice_area;
  const double u = std::clamp(-scale * glm::dot(ac, across), 0.0, 1.0);
  const double w = std::clamp(scale * glm::dot(ab, across), 0.0, 1.0 - u);
  // The point is that of the ray, put onto the plane once more, and not that of the coordinates: on the edge, or
  // rounded as they are, it could lie before a neighbouring face, and a ray would leave both in turn for ever.
  const Vec3d point = origin + met.t * d;
  const Vec3d in_plane = point + (plane.offset - glm::dot(plane.normal, point)) * plane.normal;
  fill_in(mesh, triangle, twice_area, in_plane, Vec2(u, w), hit);
}

void locate(const MeshShape& mesh, uint32_t triangle, const Vec2& barycentric, Hit& hit) {
  const glm::uvec3& v = mesh.triangles[triangle];
  const Vec3 &a = mesh.positions[v.x], &b = mesh.positions[v.y], &c = mesh.positions[v.z];
  const double u = barycentric.x, w = barycentric.y;
  const Vec3d point = (1.0 - u - w) * Vec3d(a) + u * Vec3d(b) + w * Vec3d(c);
  fill_in(mesh, triangle, glm::length(area_vector(a, b, c)), point, barycentric, hit);
}

void locate(const SphereShape& sphere, const Ray& ray, const Crossing& met, Hit& hit) {
  const Vec3d normal = sphere_normal(sphere, ray, met.t);
  hit.position = point_on(sphere, normal);
  hit.normal = Vec3(normal);
  hit.slack = sphere_slack(sphere);
  hit.shading_normal = hit.normal;
}

void locate(const DiscShape& disc, const Ray& ray, const Crossing& met, Hit& hit) {
  hit.position = Vec3(disc_point(disc, ray, met.t));
  hit.normal = disc.normal;
  hit.slack = disc_slack(disc);
  hit.shading_normal = hit.normal;
}

}  // namespace vpm
