// Checks of vertices, of what they carry, of triangles and of radii.
#include "vpm/surface/check_shapes.h"

#include <algorithm>
#include <string>

#include "vpm/base/error.h"
#include "vpm/surface/mesh.h"

namespace vpm {
namespace {

/// Embree leaves out what is beyond 1.8e18 m; squares of coordinates must stay finite in float too.
constexpr float kMaxCoordinate = 1e9f;
/// Beyond it floats have too few places in a repeated picture.
constexpr float kMaxUv = 1e6f;

bool in_range(const Vec3& p) {
  return std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate && std::abs(p.z) <= kMaxCoordinate;
}

/// The triangles that have an area; checks vertices and triangles on the way.
std::vector<glm::uvec3> proper_triangles(const TriangleMesh& mesh) {
  const auto& p = mesh.positions;
  for (size_t i = 0; i < p.size(); ++i) {
    if (!in_range(p[i])) throw InputError("mesh: vertex " + std::to_string(i) + " is not finite or beyond 1e9 m");
  }
  std::vector<glm::uvec3> proper;
  proper.reserve(mesh.triangles.size());
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& v = mesh.triangles[i];
    const uint32_t last = std::max(v.x, std::max(v.y, v.z));
    if (last >= p.size()) {
      throw InputError("mesh: triangle " + std::to_string(i) + " names vertex " + std::to_string(last) +
                       ", but there are " + std::to_string(p.size()) + " (counted from 0)");
    }
    if (area_vector(p[v.x], p[v.y], p[v.z]) != Vec3d(0.0)) proper.push_back(v);
  }
  if (proper.empty()) throw InputError("mesh: it has no triangle with an area, at least one is needed");
  return proper;
}

/// Checks one of the lists that hold a value for each vertex, or none at all.
template <class T, class Good>
void check_attribute(const std::vector<T>& values, size_t vertices, const std::string& name, const std::string& rule,
                     Good&& good) {
  if (values.empty()) return;
  if (values.size() != vertices)
    throw InputError("mesh: there are " + std::to_string(values.size()) + " " + name + "s for " +
                     std::to_string(vertices) + " vertices; it needs one each, or none");
  for (size_t i = 0; i < values.size(); ++i)
    if (!good(values[i])) throw InputError("mesh: the " + name + " of vertex " + std::to_string(i) + " is " + rule);
}

void check_attributes(const TriangleMesh& mesh) {
  check_attribute(mesh.normals, mesh.positions.size(), "normal", "zero or not finite",
                  [](const Vec3& n) { return is_finite(n) && n != Vec3(0.0f); });
  check_attribute(mesh.uvs, mesh.positions.size(), "uv", "not finite or beyond 1e6",
                  [](const Vec2& uv) { return std::abs(uv.x) <= kMaxUv && std::abs(uv.y) <= kMaxUv; });
}

}  // namespace

std::vector<glm::uvec3> checked_triangles(const TriangleMesh& mesh) {
  std::vector<glm::uvec3> proper = proper_triangles(mesh);
  check_attributes(mesh);
  return proper;
}

void check_round(const char* title, const Vec3& center, float radius) {
  if (!in_range(center)) throw InputError(std::string(title) + ": the centre is not finite or beyond 1e9 m");
  if (!(radius > 0.0f && radius <= kMaxCoordinate)) {
    throw InputError(std::string(title) + ": the radius is " + std::to_string(radius) +
                     " m, it must be positive and at most 1e9 m");
  }
}

}  // namespace vpm
