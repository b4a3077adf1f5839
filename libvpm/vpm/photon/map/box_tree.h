// A hierarchy of boxes over leaves, for rays, bundles of rays and points. The sixteen boxes below a box are met at
// once: four levels of the binary tree that leaves are sorted by (leaf_order.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "vpm/base/cancel.h"
#include "vpm/base/floats.h"
#include "vpm/base/parallel.h"
#include "vpm/base/vec.h"
#include "vpm/photon/map/ray_bundle.h"

namespace vpm {

class BoxTree {
 public:
  BoxTree() = default;
  /// Of `leaves` leaves, a power of 2 up to 2^32; box_of(leaf) is the box around one, and is called on all threads.
  template <class BoxOf>
  BoxTree(size_t leaves, BoxOf&& box_of);

  /// Calls visit(leaf) for the leaves whose boxes the interval of the ray meets, in a fixed order.
  template <class Visit>
  void visit_leaves(const Ray& ray, const Interval& interval, Visit&& visit) const;
  /// The same for the leaves whose boxes hold the point.
  template <class Visit>
  void visit_leaves(const Vec3& point, Visit&& visit) const;
  /// The same for the leaves of which some place may lie among the rays of a bundle.
  template <class Visit>
  void visit_leaves(const RayBundle& bundle, Visit&& visit) const;

  size_t memory_bytes() const { return 6 * lo_[0].capacity() * sizeof(float); }

 private:
  static constexpr int kLevels = 4;          // of the binary tree between a box and those below it
  static constexpr int kMostDepth = 8;       // of boxes: 2^32 leaves
  static constexpr size_t kChunk = 1 << 10;  // leaves one thread takes at once

  /// A ray as boxes are met. Along each axis it enters a box at the near plane times `inverse` plus `enter`, m, and
  /// leaves it at the far plane times `inverse` plus `leave`.
  struct Beam {
    Interval interval;
    Vec3 inverse, enter, leave;
    std::array<const float*, 3> near, far;  // of all boxes: their lower sides or their upper ones
  };
  Beam make_beam(const Ray& ray, const Interval& interval) const;
  /// The first of the boxes below a box, numbered among those of their depth, and how many there are.
  std::pair<uint32_t, uint32_t> children(int depth, uint32_t box) const {
    const uint32_t most = 1u << kLevels;
    return {box * most, static_cast<uint32_t>(std::min<size_t>(most, begin_[depth + 2] - begin_[depth + 1]))};
  }
  /// Appends to `met` which of the `count` boxes from that place on the beam meets, numbered from `first` on. Returns
  /// how many it does.
  uint32_t meet(const Beam& beam, size_t place, uint32_t count, uint32_t first, uint32_t* met) const;
  /// Likewise, for the boxes that hold the point.
  uint32_t meet(const Vec3& point, size_t place, uint32_t count, uint32_t first, uint32_t* met) const;
  /// Likewise, for the boxes that no plane around the bundle parts from it.
  uint32_t meet(const RayBundle& bundle, size_t place, uint32_t count, uint32_t first, uint32_t* met) const;
  /// Appends likewise which of the `count` first lanes the mask is set in.
  static uint32_t append(const LaneMask& mask, uint32_t count, uint32_t first, uint32_t* met);
  /// Visits the leaves that meet() finds.
  template <class Where, class Visit>
  void descend(const Where& where, Visit&& visit) const;
  void allocate(size_t leaves);
  void set(size_t place, const Box& box);
  void join_boxes();

  int depth_ = 0;                               // of the leaves' boxes; the root's is 0
  std::array<size_t, kMostDepth + 2> begin_{};  // of the boxes of each depth, and one past the last
  std::array<std::vector<float>, 3> lo_, hi_;   // m
};

template <class BoxOf>
BoxTree::BoxTree(size_t leaves, BoxOf&& box_of) {
  allocate(leaves);
  parallel_for_chunks(leaves, kChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t leaf = begin; leaf < end; ++leaf) set(begin_[depth_] + leaf, box_of(leaf));
  });
  join_boxes();
}

inline uint32_t BoxTree::append(const LaneMask& mask, uint32_t count, uint32_t first, uint32_t* met) {
  return store_numbers(first, bits_of(mask) & ((1u << count) - 1), met);
}

inline uint32_t BoxTree::meet(const Beam& beam, size_t place, uint32_t count, uint32_t first, uint32_t* met) const {
  Floats enter = beam.interval.t0, leave = beam.interval.t1;
  for (int axis = 0; axis < 3; ++axis) {
    enter = max(lanes_of(beam.near[axis] + place) * beam.inverse[axis] + beam.enter[axis], enter);
    leave = min(lanes_of(beam.far[axis] + place) * beam.inverse[axis] + beam.leave[axis], leave);
  }
  return append(enter <= leave, count, first, met);
}

inline uint32_t BoxTree::meet(const Vec3& point, size_t place, uint32_t count, uint32_t first, uint32_t* met) const {
  LaneMask holds = -1;
  for (int axis = 0; axis < 3; ++axis)
    holds &= (lanes_of(lo_[axis].data() + place) <= point[axis]) & (lanes_of(hi_[axis].data() + place) >= point[axis]);
  return append(holds, count, first, met);
}

inline uint32_t BoxTree::meet(const RayBundle& bundle, size_t place, uint32_t count, uint32_t first,
                              uint32_t* met) const {
  const HalfSpaces& region = bundle.region();
  LaneMask inside = -1;
  for (int k = 0; k < region.count(); ++k) {
    const Vec3 n = region.normal(k);
    const auto side = [&](int axis) { return (n[axis] > 0.0f ? hi_ : lo_)[axis].data() + place; };
    const Floats3 most_inside = Floats3::of(side(0), side(1), side(2)) - bundle.apex();
    inside &= dot(n, most_inside) - region.offset(k) >= 0.0f;
  }
  return append(inside, count, first, met);
}

template <class Visit>
void BoxTree::visit_leaves(const Ray& ray, const Interval& interval, Visit&& visit) const {
  descend(make_beam(ray, interval), visit);
}

template <class Visit>
void BoxTree::visit_leaves(const Vec3& point, Visit&& visit) const {
  descend(point, visit);
}

template <class Visit>
void BoxTree::visit_leaves(const RayBundle& bundle, Visit&& visit) const {
  descend(bundle, visit);
}

template <class Where, class Visit>
void BoxTree::descend(const Where& where, Visit&& visit) const {
  struct Group {
    uint32_t begin, end;  // of `met`
  };
  // Boxes met and not looked into yet, depth by depth.
  uint32_t met[(kMostDepth + 1) * kBlock] = {0};
  Group waiting[kMostDepth + 1];
  waiting[0] = {0, 1};
  for (int depth = 0; depth >= 0;) {
    Group& group = waiting[depth];
    if (group.begin == group.end) {
      --depth;
      continue;
    }
    const uint32_t box = met[group.begin++];
    if (depth == depth_) {
      cancellation_point();
      visit(box);
      continue;
    }
    const auto [first, below] = children(depth, box);
    const uint32_t begin = group.end, hits = meet(where, begin_[depth + 1] + first, below, first, met + begin);
    waiting[++depth] = {begin, begin + hits};
  }
}

}  // namespace vpm
