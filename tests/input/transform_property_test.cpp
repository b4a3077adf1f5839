// Meshes under any transform keep their normals outward.
#include <glm/gtc/matrix_transform.hpp>

#include "support/properties.h"
#include "vpm/surface/mesh.h"

namespace vpm {
namespace {

RC_GTEST_PROP(TransformProperty, MeshesKeepTheirNormalsOutward, ()) {
  Mat4d m = glm::translate(Mat4d(1.0), Vec3d(*vector_in(-10, 10)));
  for (int i = 0; i < 2; ++i) {
    m = glm::rotate(m, *number(-3.2, 3.2), Vec3d(*unit_vector()));
    const Vec3d size(*magnitude(0.1, 10), *magnitude(0.1, 10), *magnitude(0.1, 10));
    m = glm::scale(m,
                   size * Vec3d(*rc::gen::element(Vec3(1, 1, 1), Vec3(-1, 1, 1), Vec3(-1, -1, -1), Vec3(1, -1, -1))));
  }
  TriangleMesh mesh = box_mesh(Vec3d(-1.0), Vec3d(1.0));
  transform_mesh(m, mesh);
  const Vec3d center(m[3]);
  double volume = 0.0;  // of the tetrahedra from the center to the faces: all positive where normals are outward
  for (const glm::uvec3& v : mesh.triangles) {
    const Vec3d a = Vec3d(mesh.positions[v.x]) - center, b = Vec3d(mesh.positions[v.y]) - center,
                c = Vec3d(mesh.positions[v.z]) - center;
    volume += glm::dot(a, glm::cross(b, c)) / 6.0;
  }
  const double exact = 8.0 * std::abs(glm::determinant(Mat3d(m)));
  double reach = 0.0;
  for (const Vec3& p : mesh.positions) reach = std::max(reach, glm::length(Vec3d(p) - center));
  // Corners are rounded to floats: each face moves by a rounding of its coordinates.
  const double rounding = 2e-6 * (glm::length(center) + reach) * reach * reach;
  RC_ASSERT(std::abs(volume - exact) < rounding);
  RC_CLASSIFY(exact > 10.0 * rounding, "normals certain");
}

}  // namespace
}  // namespace vpm
