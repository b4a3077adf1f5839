// Building the boxes, from the leaves up.
#include "vpm/photon/map/box_tree.h"

#include <cmath>

namespace vpm {

void BoxTree::allocate(size_t leaves) {
  while ((size_t{1} << (kLevels * depth_)) < leaves) ++depth_;
  for (int d = 0; d <= depth_; ++d) begin_[d + 1] = begin_[d] + std::max<size_t>(1, leaves >> (kLevels * (depth_ - d)));
  for (int a = 0; a < 3; ++a) {
    lo_[a].assign(begin_[depth_ + 1] + kBlock, kInfinity);  // whole blocks are read
    hi_[a].assign(begin_[depth_ + 1] + kBlock, -kInfinity);
  }
}

void BoxTree::set(size_t place, const Box& box) {
  for (int a = 0; a < 3; ++a) {
    lo_[a][place] = box.lo[a];
    hi_[a][place] = box.hi[a];
  }
}

/// Makes the boxes above the leaves.
void BoxTree::join_boxes() {
  for (int d = depth_; d-- > 0;)
    for (size_t box = 0; box < begin_[d + 1] - begin_[d]; ++box) {
      const auto [first, count] = children(d, static_cast<uint32_t>(box));
      for (int a = 0; a < 3; ++a) {
        const auto low = lo_[a].begin() + static_cast<std::ptrdiff_t>(begin_[d + 1] + first);
        const auto high = hi_[a].begin() + static_cast<std::ptrdiff_t>(begin_[d + 1] + first);
        lo_[a][begin_[d] + box] = *std::min_element(low, low + count);
        hi_[a][begin_[d] + box] = *std::max_element(high, high + count);
      }
    }
}

BoxTree::Beam BoxTree::make_beam(const Ray& ray, const Interval& interval) const {
  // Boxes are met a hair wider than they are, as planes are rounded; and no component of the direction is so small that
  // 0 times its inverse has no value.
  const Vec3 lo(lo_[0][0], lo_[1][0], lo_[2][0]), hi(hi_[0][0], hi_[1][0], hi_[2][0]);  // of the root
  const Vec3 reach = glm::max(glm::max(glm::abs(lo), glm::abs(hi)), glm::abs(ray.origin));
  const float wider = 1e-6f * max_channel(reach);
  Beam beam{interval, {}, {}, {}, {}, {}};
  for (int a = 0; a < 3; ++a) {
    const float d = ray.direction[a], sign = std::copysign(1.0f, d);
    beam.inverse[a] = 1.0f / (std::abs(d) < 1e-12f ? sign * 1e-12f : d);
    beam.enter[a] = (-sign * wider - ray.origin[a]) * beam.inverse[a];
    beam.leave[a] = (sign * wider - ray.origin[a]) * beam.inverse[a];
    beam.near[a] = (d < 0.0f ? hi_ : lo_)[a].data();
    beam.far[a] = (d < 0.0f ? lo_ : hi_)[a].data();
  }
  return beam;
}

}  // namespace vpm
