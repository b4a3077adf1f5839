// The simplest meshes, boxes and quads, and the triangles that are none.
#pragma once

#include "surface/geometry.h"

namespace vpm {

/// The box [lo, hi] as twelve triangles with normals outward.
TriangleMesh box_mesh(const Vec3d& lo, const Vec3d& hi);

/// The parallelogram of a corner and two edges as two triangles, with the normal cross(u, v). Its coordinates in
/// a texture are the shares of the edges: (0, 0) at the corner, (1, 0) at the end of u, (0, 1) at that of v.
TriangleMesh quad_mesh(const Vec3d& corner, const Vec3d& u, const Vec3d& v);

/// Removes the triangles without area, which no ray can meet, and tells how many they were.
uint64_t drop_flat_triangles(TriangleMesh& mesh);

}  // namespace vpm
