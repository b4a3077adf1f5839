// Where a ray meets a shape. Embree's own distances and barycentric coordinates come from approximate reciprocals,
// which differ from processor to processor: what becomes of a ray must not depend on them.
#pragma once

#include "vpm/base/memory/huge_pages.h"
#include "vpm/surface/geometry.h"

namespace vpm {

/// Every hit has t > kMinT, m. It is the smallest normal float, so that t > 0 in every rounding mode.
inline constexpr float kMinT = std::numeric_limits<float>::min();

/// What a triangle's corners say of its plane, once for all rays. None lies across two cache lines.
struct alignas(32) TrianglePlane {
  Vec3d normal;   // unit, outward
  double offset;  // m: dot(normal, p) of its points p
};

/// A mesh: positions and triangles in Embree's own buffers, and the data that Embree does not need.
struct MeshShape {
  const Vec3* positions = nullptr;
  const glm::uvec3* triangles = nullptr;
  LargeTable<TrianglePlane> planes;  // of the triangles
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;
};

/// The value at the point of a triangle that has these barycentric coordinates: the weights of its second and third
/// vertex.
template <class T>
T interpolated(const std::vector<T>& values, const glm::uvec3& v, const Vec2& barycentric) {
  return (1.0f - barycentric.x - barycentric.y) * values[v.x] + barycentric.x * values[v.y] +
         barycentric.y * values[v.z];
}

/// Where a ray crosses a shape.
struct Crossing {
  double t = kInfinity;         // m; negative behind the origin, infinite or NaN where nothing is met
  double inverse_cosine = 1.0;  // of the angle to the normal, with its sign; 1 for spheres, whose t is exact
};

/// In double. That a ray meets the triangle, and not its plane alone, is for others to say. It never meets a plane that
/// it lies in up to the rounding of doubles.
Crossing crossing(const MeshShape& mesh, uint32_t triangle, const Ray& ray);
Crossing crossing(const SphereShape& sphere, const Ray& ray);
Crossing crossing(const DiscShape& disc, const Ray& ray);

/// These fill in the members of a hit from `position` on, from what crossing() gave. The point of a triangle's plane is
/// where the ray crosses it, which may be a rounding error beside the triangle; the barycentric coordinates, by
/// Cramer's rule [Moeller1997], are those of its edge then. For a sphere the point is projected onto it.
void locate(const MeshShape& mesh, uint32_t triangle, const Ray& ray, const Crossing& met, Hit& hit);
void locate(const SphereShape& sphere, const Ray& ray, const Crossing& met, Hit& hit);
void locate(const DiscShape& disc, const Ray& ray, const Crossing& met, Hit& hit);
/// The same of a given point of a triangle: it lies in the plane.
void locate(const MeshShape& mesh, uint32_t triangle, const Vec2& barycentric, Hit& hit);

/// The smallest root t >= t_min > 0 of |origin + t direction - center| = radius, in m; infinity where there is none.
double intersect_sphere(const SphereShape& sphere, const Ray& ray, float t_min);
/// The outward unit normal at the point of the sphere next to origin + t direction.
Vec3d sphere_normal(const SphereShape& sphere, const Ray& ray, double t);
/// The box around a sphere.
inline Box bounds_of(const SphereShape& sphere) {
  return {sphere.center - sphere.radius, sphere.center + sphere.radius};
}

/// The coordinates in a texture of the point of a sphere with that unit outward normal: u the angle about the y axis
/// over 2 pi, from +z (0) over +x (1/4); v the height in angle over pi, from -y (0) to +y (1). As of a globe whose
/// north is up and that is seen from outside, the map is not mirrored.
Vec2 sphere_uv(const Vec3& normal);

/// The t >= t_min > 0 at which the ray meets the disc, in m; infinity where it does not.
double intersect_disc(const DiscShape& disc, const Ray& ray, float t_min);
/// The point of the disc's plane nearest to origin + t direction.
Vec3d disc_point(const DiscShape& disc, const Ray& ray, double t);
/// The box around a disc.
Box bounds_of(const DiscShape& disc);

}  // namespace vpm
