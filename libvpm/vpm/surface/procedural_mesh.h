// Meshes given by formulas, as fine as asked for: closed, with normals and texture coordinates at their vertices.
#pragma once

#include <span>
#include <string_view>

#include "vpm/surface/geometry.h"

namespace vpm {

struct ProceduralMesh {
  std::string_view name;
  std::string_view summary;
  TriangleMesh (*make)(int resolution);  // of so many edges along its side or around its axis, >= 3
};

/// All meshes. Where two faces meet in an edge the vertices stand twice, with the same position and a normal for each.
std::span<const ProceduralMesh> procedural_meshes();

/// The mesh of that name, or null.
const ProceduralMesh* find_procedural_mesh(std::string_view name);

}  // namespace vpm
