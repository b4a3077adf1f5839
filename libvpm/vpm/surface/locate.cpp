// Hits of meshes, spheres and discs, in double precision.
#include "vpm/surface/locate.h"

#include <algorithm>

#include "vpm/surface/disc.h"
#include "vpm/surface/sphere.h"

namespace vpm {
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

/// A triangle in double, relative to its first vertex.
struct Corners {
  Vec3d a, ab, ac;

  Corners(const MeshShape& mesh, const glm::uvec3& v)
      : a(mesh.positions[v.x]), ab(Vec3d(mesh.positions[v.y]) - a), ac(Vec3d(mesh.positions[v.z]) - a) {}
};

void locate_in(const MeshShape& mesh, uint32_t triangle, const Corners& corners, const Vec3d& across,
               const Vec2& barycentric, Hit& hit) {
  const glm::uvec3& v = mesh.triangles[triangle];
  const double u = barycentric.x, w = barycentric.y;
  hit.position = Vec3(corners.a + u * corners.ab + w * corners.ac);
  const double twice_area = glm::length(across);
  hit.normal = Vec3(across / twice_area);
  const Vec3 &a = mesh.positions[v.x], &b = mesh.positions[v.y], &c = mesh.positions[v.z], &p = hit.position;
  const Vec3 reach = glm::max(glm::max(glm::abs(a - p), glm::abs(b - p)), glm::abs(c - p));
  hit.slack = flat_slack(hit.normal, reach, twice_area);
  hit.triangle = triangle;
  hit.barycentric = barycentric;
  hit.shading_normal = shading_normal(mesh, v, hit);
}

double sum_of_sizes(const Vec3d& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

constexpr double kRounding = 0x1p-20;  // eight times the spacing of floats in [1, 2)

/// Of a shape met by double's own arithmetic: coordinates are rounded.
Crossing crossing_at(double t, const Vec3& centre, float radius) {
  const double size = t + sum_of_sizes(Vec3d(centre)) + radius;
  return {static_cast<float>(t), static_cast<float>(kRounding * size)};
}

}  // namespace

Crossing crossing(const MeshShape& mesh, uint32_t triangle, const Ray& ray) {
  const Corners corners(mesh, mesh.triangles[triangle]);
  const Vec3d o(ray.origin), from_a = o - corners.a, across = glm::cross(corners.ab, corners.ac);
  const double scale = -1.0 / glm::dot(Vec3d(ray.direction), across);
  const double t = scale * glm::dot(from_a, across);
  // Coordinates are rounded, in Embree those relative to the origin, and the plane is met at an angle.
  const double size = sum_of_sizes(o) + sum_of_sizes(from_a) + sum_of_sizes(corners.ab) + sum_of_sizes(corners.ac);
  const double rounding = kRounding * size * sum_of_sizes(across) * std::abs(scale);
  return {static_cast<float>(t), static_cast<float>(rounding)};
}

Crossing crossing(const SphereShape& sphere, const Ray& ray) {
  return crossing_at(intersect_sphere(sphere, ray, kMinT), sphere.centre, sphere.radius);
}

Crossing crossing(const DiscShape& disc, const Ray& ray) {
  return crossing_at(intersect_disc(disc, ray, kMinT), disc.centre, disc.radius);
}

void locate(const MeshShape& mesh, uint32_t triangle, const Ray& ray, Hit& hit) {
  const Corners corners(mesh, mesh.triangles[triangle]);
  const Vec3d d(ray.direction), normal = glm::cross(corners.ab, corners.ac);
  const Vec3d across = glm::cross(Vec3d(ray.origin) - corners.a, d);
  const double scale = 1.0 / glm::dot(d, normal);
  const double u = std::clamp(-scale * glm::dot(corners.ac, across), 0.0, 1.0);
  const double w = std::clamp(scale * glm::dot(corners.ab, across), 0.0, 1.0 - u);
  locate_in(mesh, triangle, corners, normal, Vec2(u, w), hit);
}

void locate(const MeshShape& mesh, uint32_t triangle, const Vec2& barycentric, Hit& hit) {
  const Corners corners(mesh, mesh.triangles[triangle]);
  locate_in(mesh, triangle, corners, glm::cross(corners.ab, corners.ac), barycentric, hit);
}

void locate(const SphereShape& sphere, const Ray& ray, Hit& hit) {
  const Vec3d normal = sphere_normal(sphere, ray, intersect_sphere(sphere, ray, kMinT));
  hit.position = point_on(sphere, normal);
  hit.normal = Vec3(normal);
  hit.slack = sphere_slack(sphere);
  hit.shading_normal = hit.normal;
}

void locate(const DiscShape& disc, const Ray& ray, Hit& hit) {
  hit.position = Vec3(disc_point(disc, ray, intersect_disc(disc, ray, kMinT)));
  hit.normal = disc.normal;
  hit.slack = disc_slack(disc);
  hit.shading_normal = hit.normal;
}

}  // namespace vpm
