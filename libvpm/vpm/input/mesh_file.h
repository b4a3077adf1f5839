// Triangle meshes from PLY and OBJ files.
#pragma once

#include <cstdint>
#include <string>

#include "vpm/surface/geometry.h"

namespace vpm {

struct LoadedMesh {
  TriangleMesh mesh;
  uint64_t degenerate_triangles = 0;  // without area: dropped
};

/// Reads the mesh in a .ply (ascii, binary of either byte order) or .obj file. Polygons are split into fans from their
/// first corner, right for convex ones. Read are positions, faces, and of vertices normals (PLY: nx, ny, nz) and
/// texture coordinates (PLY: u and v, s and t, or texture_u and texture_v); all else is skipped. Throws InputError
/// where the file is damaged, holds no face with an area, names vertices, normals or texture coordinates that it does
/// not have or has for a part of its corners only, has values of them that are not finite, or normals of length zero.
LoadedMesh load_mesh(const std::string& path);

/// A mesh from elsewhere, without its triangles that have no area. Throws InputError, "name: ...", where it holds no
/// face with an area, or faces name vertices that it does not have; `first` is the number of the first vertex.
LoadedMesh checked_mesh(const std::string& name, TriangleMesh mesh, uint64_t first = 0);

}  // namespace vpm
