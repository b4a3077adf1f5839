// The simplest meshes, boxes and quads; the areas of triangles, and those that have none.
#pragma once

#include "vpm/surface/geometry.h"

namespace vpm {

/// The box [lo, hi] as twelve triangles with normals outward.
TriangleMesh box_mesh(const Vec3d& lo, const Vec3d& hi);

/// The parallelogram of a corner and two edges as two triangles, with the normal cross(u, v). Its coordinates in
/// a texture are the shares of the edges: (0, 0) at the corner, (1, 0) at the end of u, (0, 1) at that of v.
TriangleMesh quad_mesh(const Vec3d& corner, const Vec3d& u, const Vec3d& v);

/// (b - a) x (c - a): outward, normal to the triangle, twice its area long, m^2.
inline Vec3d area_vector(const Vec3& a, const Vec3& b, const Vec3& c) {
  return glm::cross(Vec3d(b) - Vec3d(a), Vec3d(c) - Vec3d(a));
}

/// A parallelogram: what quad_mesh() makes, moved by transform_mesh(). Unlike two triangles it emits as one light.
struct QuadMesh {
  TriangleMesh mesh;
};

/// Moves a mesh by an affine map. Its normals stay outward under mirrors too.
void transform_mesh(const Mat4d& transform, TriangleMesh& mesh);

/// Removes the triangles without area, which no ray can meet, and tells how many they were.
uint64_t drop_flat_triangles(TriangleMesh& mesh);

}  // namespace vpm
