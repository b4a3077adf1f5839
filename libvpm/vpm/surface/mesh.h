// Simple meshes (boxes and quads), the areas of triangles, and the removal of triangles without area.
#pragma once

#include "vpm/surface/geometry.h"

namespace vpm {

/// The box [lo, hi] as twelve triangles with normals outward.
TriangleMesh box_mesh(const Vec3d& lo, const Vec3d& hi);

/// The parallelogram of a corner and two edges as two triangles, with the normal cross(u, v). Its texture coordinates
/// are (0, 0) at the corner, (1, 0) at the end of u and (0, 1) at the end of v.
TriangleMesh quad_mesh(const Vec3d& corner, const Vec3d& u, const Vec3d& v);

/// (b - a) x (c - a): the outward normal of the triangle; its length is twice the area, m^2.
inline Vec3d area_vector(const Vec3& a, const Vec3& b, const Vec3& c) {
  return glm::cross(Vec3d(b) - Vec3d(a), Vec3d(c) - Vec3d(a));
}

/// A parallelogram: a mesh from quad_mesh(), moved by transform_mesh(). Unlike two triangles it emits as one light.
struct QuadMesh {
  TriangleMesh mesh;
};

/// Does each edge have as many triangles on one of its sides as on the other, by the places of its ends?
bool is_closed(const TriangleMesh& mesh);

/// Transforms a mesh by an affine map. Its normals stay outward under reflections too.
void transform_mesh(const Mat4d& transform, TriangleMesh& mesh);

/// Removes the triangles without area, which no ray can meet, and returns their number.
uint64_t drop_flat_triangles(TriangleMesh& mesh);

}  // namespace vpm
