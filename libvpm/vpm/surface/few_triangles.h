// Scenes of a few triangles, all of which are looked at for each ray: quicker than a tree of them.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "vpm/surface/locate.h"

namespace vpm {

/// Which triangles the line of a ray goes through: those all three edges of which it passes on one side. The side is
/// the sign of the product of Pluecker coordinates [Shoemake1998]; the three products add up to twice the area as seen
/// along the line. As with Embree a line that passes an edge by less than a float's rounding meets it, so that none
/// slips through between triangles whose corners are the same up to their rounding.
class FewTriangles {
 public:
  /// Of more a tree is quicker.
  static constexpr size_t kMost = 48;

  /// Adds the triangles of a mesh, which must stay where it is.
  void add(const MeshShape& mesh, uint32_t shape, uint32_t layer);
  /// Calls met(mesh, shape, triangle) for each triangle of these layers that the line of the ray goes through, also
  /// behind its origin.
  template <class Use>
  void visit(const Ray& ray, uint32_t layers, Use&& met) const;
  size_t memory_bytes() const { return blocks_.capacity() * sizeof(Block); }

 private:
  static constexpr int kLanes = 8;
  static constexpr uint64_t kBits[kLanes] = {1, 2, 4, 8, 16, 32, 64, 128};
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
  /// The triangles of a block that a line goes through, as bits.
  static uint64_t find(const Block& block, const Vec3d& direction, const Vec3d& moment);

  std::vector<Block> blocks_;
  size_t count_ = 0;
};

inline uint64_t FewTriangles::find(const Block& block, const Vec3d& direction, const Vec3d& moment) {
  uint64_t met = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    double side[3];
    for (int i = 0; i < 3; ++i) {
      const Edge& edge = block.edges[i];
      side[i] = direction.x * edge.moment[0][lane] + direction.y * edge.moment[1][lane] +
                direction.z * edge.moment[2][lane] +
                (moment.x * edge.along[0][lane] + moment.y * edge.along[1][lane] + moment.z * edge.along[2][lane]);
    }
    const double rounding = 0x1p-23 * std::abs(side[0] + side[1] + side[2]);
    const bool left = (side[0] >= -rounding) & (side[1] >= -rounding) & (side[2] >= -rounding);
    const bool right = (side[0] <= rounding) & (side[1] <= rounding) & (side[2] <= rounding);
    met |= left | right ? kBits[lane] : 0;
  }
  return met;
}

template <class Use>
void FewTriangles::visit(const Ray& ray, uint32_t layers, Use&& met) const {
  const Vec3d direction(ray.direction), moment = glm::cross(Vec3d(ray.origin), direction);
  for (const Block& block : blocks_) {
    for (uint64_t left = find(block, direction, moment); left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      if ((block.layer[lane] & layers) != 0) met(*block.mesh[lane], block.shape[lane], block.triangle[lane]);
    }
  }
}

}  // namespace vpm
