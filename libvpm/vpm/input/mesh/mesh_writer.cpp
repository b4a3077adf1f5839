// PLY: a header that names the properties, then their bytes.
#include "vpm/input/mesh/mesh_writer.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>

#include "vpm/base/atomic_file.h"
#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/surface/procedural_mesh.h"

namespace vpm {
namespace {

void append(std::string& bytes, uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xff);
}
void append(std::string& bytes, float value) { append(bytes, std::bit_cast<uint32_t>(value)); }

template <class Vector>
void append_all(std::string& bytes, const Vector& v) {
  for (int i = 0; i < Vector::length(); ++i) append(bytes, v[i]);
}

std::string header(const TriangleMesh& mesh) {
  std::string text = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", mesh.positions.size());
  const auto add_floats = [&text](std::initializer_list<const char*> names) {
    for (const char* name : names) text += fmt::format("property float {}\n", name);
  };
  add_floats({"x", "y", "z"});
  if (!mesh.normals.empty()) add_floats({"nx", "ny", "nz"});
  if (!mesh.uvs.empty()) add_floats({"s", "t"});
  return text +
         fmt::format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n", mesh.triangles.size());
}

}  // namespace

void write_ply(const TriangleMesh& mesh, const std::string& path) {
  std::string bytes = header(mesh);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    cancellation_point();
    append_all(bytes, mesh.positions[i]);
    if (!mesh.normals.empty()) append_all(bytes, mesh.normals[i]);
    if (!mesh.uvs.empty()) append_all(bytes, mesh.uvs[i]);
  }
  for (const glm::uvec3& triangle : mesh.triangles) {
    cancellation_point();
    bytes += '\3';  // corners
    append_all(bytes, triangle);
  }
  write_text(path, bytes);
}

void write_procedural_mesh(const std::string& name, int resolution, const std::string& path) {
  const ProceduralMesh* found = find_procedural_mesh(name);
  if (!found) {
    std::string names;
    for (const ProceduralMesh& mesh : procedural_meshes())
      names += fmt::format("{}{}", names.empty() ? "" : ", ", mesh.name);
    throw InputError(fmt::format("there is no mesh '{}' to make; there are: {}", name, names));
  }
  if (resolution < 3 || resolution > 2048)
    throw InputError(fmt::format("resolution {}: must lie between 3 and 2048", resolution));
  write_ply(found->make(resolution), path);
}

}  // namespace vpm
