// Hits of meshes, spheres and discs, in double precision.
#include "vpm/surface/locate.h"

#include "vpm/surface/disc.h"
#include "vpm/surface/mesh.h"
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

}  // namespace

void locate(const MeshShape& mesh, uint32_t triangle, const Vec2& barycentric, Hit& hit) {
  const glm::uvec3& v = mesh.triangles[triangle];
  const Vec3 &a = mesh.positions[v.x], &b = mesh.positions[v.y], &c = mesh.positions[v.z];
  const double u = barycentric.x, w = barycentric.y;
  hit.position = Vec3((1.0 - u - w) * Vec3d(a) + u * Vec3d(b) + w * Vec3d(c));
  const Vec3d across = area_vector(a, b, c);
  const double twice_area = glm::length(across);
  hit.normal = Vec3(across / twice_area);
  const Vec3& p = hit.position;
  const Vec3 reach = glm::max(glm::max(glm::abs(a - p), glm::abs(b - p)), glm::abs(c - p));
  hit.slack = flat_slack(hit.normal, reach, twice_area);
  hit.triangle = triangle;
  hit.barycentric = barycentric;
  hit.shading_normal = shading_normal(mesh, v, hit);
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
