// Triangle meshes from PLY and OBJ files.
#pragma once

#include <cstdint>
#include <string>

#include "vpm/scene/parts.h"
#include "vpm/surface/geometry.h"

namespace vpm {

struct LoadedMesh {
  TriangleMesh mesh;
  MeshNotes notes;
};

/// Reads the mesh in a .ply (ascii, binary of either byte order) or .obj file. Read are positions, faces (also strips
/// of triangles), normals (PLY: nx, ny, nz of vertices) and texture coordinates (PLY: u and v, s and t, or texture_u
/// and texture_v of vertices, else texcoord of faces); all else is skipped, and free-form surfaces are counted.
/// Polygons are split as split_polygon() does. Where some corners have no normal, or one that is zero or not finite,
/// that is the normal of their triangle, and where some have no texture coordinates, these are zero; the notes count
/// what a corner names and what is no such value. Values that no face with an area uses do not matter. Throws
/// InputError where the file is damaged, holds no face with an area, a face crosses itself, names vertices, normals or
/// texture coordinates that the file does not have, or positions that are not finite.
LoadedMesh load_mesh(const std::string& path);

/// A mesh from elsewhere, without its triangles that have no area. Throws InputError, "name: ...", where it holds no
/// face with an area, or faces name vertices that it does not have.
LoadedMesh checked_mesh(const std::string& name, TriangleMesh mesh);

}  // namespace vpm
