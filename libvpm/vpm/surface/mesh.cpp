// Boxes and quads as triangles; meshes moved; triangles without area.
#include "vpm/surface/mesh.h"

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_inverse.hpp>
#include <map>

namespace vpm {

TriangleMesh box_mesh(const Vec3d& lo, const Vec3d& hi) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z);
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

TriangleMesh quad_mesh(const Vec3d& corner, const Vec3d& u, const Vec3d& v) {
  TriangleMesh mesh;
  mesh.positions = {Vec3(corner), Vec3(corner + u), Vec3(corner + u + v), Vec3(corner + v)};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.uvs = {{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}};
  return mesh;
}

void transform_mesh(const Mat4d& transform, TriangleMesh& mesh) {
  for (Vec3& p : mesh.positions) p = Vec3(transform * glm::dvec4(Vec3d(p), 1.0));
  const Mat3d of_normals = glm::inverseTranspose(Mat3d(transform));
  for (Vec3& n : mesh.normals) n = Vec3(glm::normalize(of_normals * Vec3d(n)));
  if (glm::determinant(Mat3d(transform)) > 0.0) return;
  for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);  // a mirror turns triangles round: outward stays outward
}

uint64_t drop_flat_triangles(TriangleMesh& mesh) {
  return std::erase_if(mesh.triangles, [&p = mesh.positions](const glm::uvec3& t) {
    return area_vector(p[t.x], p[t.y], p[t.z]) == Vec3d(0.0);
  });
}

bool is_closed(const TriangleMesh& mesh) {
  std::map<std::array<float, 6>, int64_t> forwards;  // less backwards: of edges, by their ends
  for (const auto& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3 &a = mesh.positions[triangle[corner]], &b = mesh.positions[triangle[(corner + 1) % 3]];
      const std::array<float, 6> forward{a.x, a.y, a.z, b.x, b.y, b.z}, backward{b.x, b.y, b.z, a.x, a.y, a.z};
      forward < backward ? ++forwards[forward] : --forwards[backward];
    }
  return std::all_of(forwards.begin(), forwards.end(), [](const auto& edge) { return edge.second == 0; });
}

}  // namespace vpm
