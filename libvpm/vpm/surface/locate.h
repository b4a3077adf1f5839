// The point where a ray met a shape, found again more exactly than the search for it did.
#pragma once

#include "vpm/surface/geometry.h"

namespace vpm {

/// Hits lie beyond this t, m: the smallest normal float, so that t > 0 in every rounding mode.
inline constexpr float kMinT = std::numeric_limits<float>::min();

/// A mesh in Embree's own buffers, and what Embree need not know of it.
struct MeshShape {
  const Vec3* positions = nullptr;
  const glm::uvec3* triangles = nullptr;
  size_t count = 0;  // of triangles
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;
};

/// The value at the point of a triangle with Embree's barycentric coordinates.
template <class T>
T interpolated(const std::vector<T>& values, const glm::uvec3& v, const Vec2& barycentric) {
  return (1.0f - barycentric.x - barycentric.y) * values[v.x] + barycentric.x * values[v.y] +
         barycentric.y * values[v.z];
}

/// Fill in what a hit tells of its place, from position on. Of a triangle by Embree's barycentric coordinates: in its
/// plane, wherever the ray came from. Of a sphere, projected onto it, and a disc by the ray.
void locate(const MeshShape& mesh, uint32_t triangle, const Vec2& barycentric, Hit& hit);
void locate(const SphereShape& sphere, const Ray& ray, Hit& hit);
void locate(const DiscShape& disc, const Ray& ray, Hit& hit);

}  // namespace vpm
