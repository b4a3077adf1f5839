// The edges of a few triangles, laid out for rays.
#include "vpm/surface/few_triangles.h"

namespace vpm {

void FewTriangles::add(const MeshShape& mesh, uint32_t shape, uint32_t layer) {
  for (uint32_t triangle = 0; triangle < mesh.planes.size(); ++triangle) {
    const size_t lane = count_++ % kLanes;
    if (lane == 0) blocks_.push_back({});
    Block& block = blocks_.back();
    for (int i = 0; i < 3; ++i) {
      const glm::uvec3& v = mesh.triangles[triangle];
      const Vec3d from(mesh.positions[v[i]]), to(mesh.positions[v[(i + 1) % 3]]);
      const Vec3d along = to - from, moment = glm::cross(from, to);
      for (int axis = 0; axis < 3; ++axis) {
        block.edges[i].along[axis][lane] = along[axis];
        block.edges[i].moment[axis][lane] = moment[axis];
      }
    }
    block.mesh[lane] = &mesh;
    block.shape[lane] = shape;
    block.triangle[lane] = triangle;
    block.layer[lane] = layer;
  }
}

}  // namespace vpm
