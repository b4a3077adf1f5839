// Reading a mesh file and checking what came out of it.
#include "vpm/input/mesh_file.h"

#include <algorithm>

#include "vpm/base/error.h"
#include "vpm/input/mesh_parts.h"
#include "vpm/input/source.h"
#include "vpm/surface/mesh.h"

namespace vpm {
namespace {

/// `first`: the number that the file's format gives to the first vertex.
void check_indices(const std::string& path, const TriangleMesh& mesh, uint64_t first) {
  for (const glm::uvec3& t : mesh.triangles) {
    const uint32_t largest = std::max({t.x, t.y, t.z});
    if (largest >= mesh.positions.size())
      fail_in_mesh(path, 0,
                   "a face names vertex " + std::to_string(largest + first) + (first == 0 ? " (counted from 0)" : "") +
                       ", but there are only " + std::to_string(mesh.positions.size()));
  }
}

}  // namespace

void fail_in_mesh(const std::string& name, size_t line, const std::string& wrong) {
  throw InputError(name + (line > 0 ? ":" + std::to_string(line) : "") + ": " + wrong);
}

void add_fan(const std::vector<uint32_t>& corners, TriangleMesh& mesh) {
  for (size_t i = 2; i < corners.size(); ++i) mesh.triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
}

LoadedMesh checked_mesh(const std::string& name, TriangleMesh mesh, uint64_t first) {
  if (mesh.triangles.empty()) fail_in_mesh(name, 0, "the mesh has no faces");
  check_indices(name, mesh, first);
  LoadedMesh loaded{std::move(mesh), 0};
  loaded.degenerate_triangles = drop_flat_triangles(loaded.mesh);
  if (loaded.mesh.triangles.empty()) fail_in_mesh(name, 0, "no face of the mesh has an area");
  return loaded;
}

LoadedMesh load_mesh(const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".ply" && extension != ".obj") fail_in_mesh(path, 0, "a mesh must be a .ply or .obj file");
  const std::string text = read_whole_file(path);
  return extension == ".ply" ? checked_mesh(path, parse_ply(path, text)) : checked_mesh(path, parse_obj(path, text), 1);
}

}  // namespace vpm
