// The point where a ray met a shape, computed again more exactly than by the intersection that found it.
#pragma once

#include "vpm/surface/geometry.h"

namespace vpm {

/// Every hit has t > kMinT, m. It is the smallest normal float, so that t > 0 in every rounding mode.
inline constexpr float kMinT = std::numeric_limits<float>::min();

/// A mesh: positions and triangles in Embree's own buffers, and the data that Embree does not need.
struct MeshShape {
  const Vec3* positions = nullptr;
  const glm::uvec3* triangles = nullptr;
  size_t count = 0;  // of triangles
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;
};

/// The value at the point of a triangle that has these barycentric coordinates, as Embree defines them.
template <class T>
T interpolated(const std::vector<T>& values, const glm::uvec3& v, const Vec2& barycentric) {
  return (1.0f - barycentric.x - barycentric.y) * values[v.x] + barycentric.x * values[v.y] +
         barycentric.y * values[v.z];
}

/// These fill in the members of a hit from `position` on. For a triangle they follow from Embree's barycentric
/// coordinates: the point lies in its plane, wherever the ray came from. For a sphere and a disc they follow from the
/// ray; for a sphere the point is projected onto it.
void locate(const MeshShape& mesh, uint32_t triangle, const Vec2& barycentric, Hit& hit);
void locate(const SphereShape& sphere, const Ray& ray, Hit& hit);
void locate(const DiscShape& disc, const Ray& ray, Hit& hit);

}  // namespace vpm
