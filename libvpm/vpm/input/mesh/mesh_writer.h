// Writing meshes into .ply files.
#pragma once

#include <string>

#include "vpm/surface/geometry.h"

namespace vpm {

/// Writes the mesh to `path` as binary PLY, little-endian on every machine, with the normals and texture coordinates
/// that it has; load_mesh() gives back the same bits. The file appears whole or not at all. Throws InputError where
/// it cannot be written.
void write_ply(const TriangleMesh& mesh, const std::string& path);

/// Writes the procedural mesh of that name. Throws InputError also for an unknown name (listing those there are) and a
/// resolution that is not within 3 and 2048.
void write_procedural_mesh(const std::string& name, int resolution, const std::string& path);

}  // namespace vpm
