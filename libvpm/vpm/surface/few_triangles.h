// Scenes of a few triangles, all of which are looked at for each ray: quicker than a tree of them.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/surface/locate.h"

namespace vpm {

/// Which triangles the line of a ray goes through. It passes each edge on one side or on the other, or meets it: that
/// is the sign of the product of their Pluecker coordinates [Shoemake1998]. An edge that two triangles share has in
/// both the same product up to its sign, to the last bit, so that no line slips through between them.
class FewTriangles {
 public:
  /// From so many on a tree is quicker.
  static constexpr size_t kMost = 48;

  /// Adds the triangles of a mesh, which must stay where it is.
  void add(const MeshShape& mesh, uint32_t shape, uint32_t layer);
  /// Calls visit(mesh, shape, triangle) for each triangle of these layers that the line of the ray goes through, also
  /// behind its origin.
  template <class Visit>
  void visit(const Ray& ray, uint32_t layers, Visit&& visit) const;
  size_t memory_bytes() const { return blocks_.capacity() * sizeof(Block); }

 private:
  static constexpr int kLanes = 8;
  using Row = double[kLanes];
  struct Edge {
    Row along[3];   // m: from one end to the other
    Row moment[3];  // m^2: the cross product of the two ends
  };
  struct alignas(64) Block {
    Edge edges[3];
    const MeshShape* mesh[kLanes];
    uint32_t shape[kLanes], triangle[kLanes];
    uint32_t layer[kLanes];  // 0: there is no triangle
  };
  using Met = int64_t[kLanes];
  static void find(const Block& block, const Vec3d& direction, const Vec3d& moment, Met& met);

  std::vector<Block> blocks_;
  size_t count_ = 0;
};

inline void FewTriangles::find(const Block& block, const Vec3d& direction, const Vec3d& moment, Met& met) {
  for (int lane = 0; lane < kLanes; ++lane) {
    double side[3];
    for (int i = 0; i < 3; ++i) {
      const Edge& edge = block.edges[i];
      side[i] = direction.x * edge.moment[0][lane] + direction.y * edge.moment[1][lane] +
                direction.z * edge.moment[2][lane] +
                (moment.x * edge.along[0][lane] + moment.y * edge.along[1][lane] + moment.z * edge.along[2][lane]);
    }
    const bool left = (side[0] >= 0.0) & (side[1] >= 0.0) & (side[2] >= 0.0);
    const bool right = (side[0] <= 0.0) & (side[1] <= 0.0) & (side[2] <= 0.0);
    met[lane] = left | right;
  }
}

template <class Visit>
void FewTriangles::visit(const Ray& ray, uint32_t layers, Visit&& visit) const {
  const Vec3d direction(ray.direction), moment = glm::cross(Vec3d(ray.origin), direction);
  for (const Block& block : blocks_) {
    Met met;
    find(block, direction, moment, met);
    for (int lane = 0; lane < kLanes; ++lane)
      if (met[lane] != 0 && (block.layer[lane] & layers) != 0)
        visit(*block.mesh[lane], block.shape[lane], block.triangle[lane]);
  }
}

}  // namespace vpm
