// Triangle meshes from PLY and OBJ files.
#pragma once

#include <cstdint>
#include <string>

#include "surface/geometry.h"

namespace vpm {

struct LoadedMesh {
  TriangleMesh mesh;
  uint64_t degenerate_triangles = 0;  // without area: dropped
};

/// Reads the mesh in a .ply (ascii, binary of either byte order) or .obj file. Polygons are split into fans from their
/// first corner, right for convex ones. Everything but positions and faces is skipped. Throws InputError where the file
/// is damaged, holds no face with an area, names vertices that it does not have, or has positions that are not finite.
LoadedMesh load_mesh(const std::string& path);

}  // namespace vpm
