// What holds for all photons below a node of a tree (leaf_order.h), for sixteen nodes side by side: where they are, how
// they arrived, and the moments of their powers. So a query may deal with nodes as a whole, and looks at the photons of
// those leaves alone that it takes a part of.
//
// A kernel that is linear in the squared distance d^2, as Epanechnikov's, sums to a linear function of sum P and
// sum P d^2 over the powers P. For the photons below a node the latter follows from its moments about any center c, the
// parallel axis theorem of mechanics: sum P d^2 = sum P |x - c|^2 - 2 (p - c) . sum P (x - c) + |p - c|^2 sum P, where
// p is the point that distances are taken from. It is exact but for rounding.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "vpm/base/below.h"
#include "vpm/base/vec.h"
#include "vpm/photon/map/leaf_order.h"
#include "vpm/photon/map/photon_batch.h"
#include "vpm/photon/map/photon_table.h"

namespace vpm {

/// Of sixteen nodes that have a node four levels above in common.
struct NodeGroup {
  float lo[3][kBlock], hi[3][kBlock];  // the box around the photons below each, m
  float normal[3][kBlock];             // unit, of a plane through three of them; 0 where there is none
  float least[kBlock], most[kBlock];   // of PackedDirection::on_octahedron() times that normal
  uint32_t photons[kBlock];            // their number; 0 where there is no node
};

/// The moments of their powers about the centers of the boxes.
struct NodeMoments {
  float power[3][kBlock];     // by channel: sum P, W
  float first[3][3][kBlock];  // by channel and axis: sum P (x - c), W m
  float second[3][kBlock];    // by channel: sum P |x - c|^2, W m^2
};

/// What a query knows of the nodes of a group. All is of the photons' own numbers, as rounding is monotonic: no sum or
/// product of floats that a photon enters with is beyond that of the side of its box.
struct GroupView {
  float nearest2[kBlock], farthest2[kBlock];  // squared distances of the nearest and the farthest place of a box, m^2
  uint32_t all[kBlock], any[kBlock];          // 1: all photons below the node are taken, some may be; else 0
};

class NodeGroups {
 public:
  /// Of the nodes above and including the `leaves` leaves that the photons of the table are sorted into, at most kBlock
  /// in each.
  NodeGroups(const PhotonTable& photons, size_t leaves);

  /// Visits the photons near `point` that accept(travel, offset) takes. Calls whole(group, uint32_t taken[kBlock],
  /// photons) for groups with nodes, marked by 1, that have all their photons nearer than the square root of `inside2`,
  /// and how many these are; and leaf(number, all) for leaves that others nearer than the square root of `outside2` >=
  /// `inside2` may be in, and whether all photons there are taken. Each photon comes once, in an order that depends on
  /// the arguments alone. accept.judge(NodeGroup, point, GroupView&) sets `all` and `any`.
  template <class Accept, class Whole, class Leaf>
  void visit(const Vec3& point, float inside2, float outside2, const Accept& accept, Whole&& whole, Leaf&& leaf) const {
    const Query<Accept, Whole, Leaf> query{point, inside2, outside2, accept, whole, leaf};
    look(0, 0, query);
  }

  /// The photons of a leaf: the first, and one past the last.
  std::pair<size_t, size_t> photons_of(size_t leaf) const {
    return {leaf_begin(photons_, leaves_, leaf), leaf_begin(photons_, leaves_, leaf + 1)};
  }
  /// A distance that all photons are nearer to the point than, m.
  float reach(const Vec3& point) const;
  /// What leaves need of kBlock photons from number `first` on, beside their positions, each in an array of its own:
  /// those behind the last photon are of no meaning.
  const PackedDirection* travel(size_t first) const { return &travel_[first]; }
  const float* power(int channel, size_t first) const { return &power_[static_cast<size_t>(channel)][first]; }  // W
  const NodeMoments& moments(size_t group) const { return moments_[group]; }
  const NodeGroup& group(size_t group) const { return groups_[group]; }
  size_t memory_bytes() const;

 private:
  static constexpr int kLevels = 4;     // of the binary tree from a group to the next
  static constexpr int kMostDepth = 8;  // of groups: 2^32 leaves

  template <class Accept, class Whole, class Leaf>
  struct Query {
    Vec3 point;
    float inside2, outside2;  // m^2
    const Accept& accept;
    Whole& whole;
    Leaf& leaf;
  };
  /// Visits what lies below the group, numbered among those of its depth.
  template <class Accept, class Whole, class Leaf>
  void look(int depth, size_t number, const Query<Accept, Whole, Leaf>& query) const;
  /// The nodes of each depth.
  size_t nodes(int depth) const { return leaves_ >> (kLevels * (depth_ - depth)); }
  void fill(int depth, size_t node, const PhotonTable& photons);

  size_t photons_, leaves_;                     // their numbers
  int depth_ = 0;                               // of the groups of leaves; there is one group of depth 0
  std::array<size_t, kMostDepth + 1> begin_{};  // of the groups of each depth
  std::vector<NodeGroup> groups_;
  std::vector<NodeMoments> moments_;
  // Of the photons, with kBlock further entries. Loops over the table's payloads, of which each reads every third word,
  // took three times as long.
  std::vector<PackedDirection> travel_;
  std::array<std::vector<float>, 3> power_;
};

/// The squared distances of boxes, rounded as those of photons are.
inline void find_distances2(const NodeGroup& nodes, const Vec3& point, GroupView& view) {
  const Vec3 p = point;
  for (uint32_t i = 0; i < kBlock; ++i) {
    const float x0 = nodes.lo[0][i] - p.x, y0 = nodes.lo[1][i] - p.y, z0 = nodes.lo[2][i] - p.z;
    const float x1 = nodes.hi[0][i] - p.x, y1 = nodes.hi[1][i] - p.y, z1 = nodes.hi[2][i] - p.z;
    const float x = std::max(0.0f, std::max(x0, -x1)), far_x = std::max(-x0, x1);
    const float y = std::max(0.0f, std::max(y0, -y1)), far_y = std::max(-y0, y1);
    const float z = std::max(0.0f, std::max(z0, -z1)), far_z = std::max(-z0, z1);
    view.nearest2[i] = x * x + y * y + z * z;
    view.farthest2[i] = far_x * far_x + far_y * far_y + far_z * far_z;
  }
}

template <class Accept, class Whole, class Leaf>
void NodeGroups::look(int depth, size_t number, const Query<Accept, Whole, Leaf>& query) const {
  const size_t place = begin_[depth] + number, first = number * kBlock;
  const NodeGroup& nodes_here = groups_[place];
  GroupView view;
  find_distances2(nodes_here, query.point, view);
  query.accept.judge(nodes_here, query.point, view);
  uint32_t taken[kBlock], which[kBlock], photons = 0;
  float passed[kBlock], unused[kBlock];  // 1: what lies below the node is not looked at
  for (uint32_t i = 0; i < kBlock; ++i) {
    taken[i] = view.farthest2[i] < query.inside2 ? view.all[i] : 0;
    photons += taken[i] * nodes_here.photons[i];
    passed[i] = ((view.nearest2[i] < query.outside2 ? view.any[i] : 0) & (taken[i] ^ 1)) != 0 ? 0.0f : 1.0f;
  }
  if (photons > 0) query.whole(place, taken, photons);
  const auto there = static_cast<uint32_t>(std::min<size_t>(kBlock, nodes(depth) - first));
  const uint32_t below = append_below(passed, there, 0.5f, 0, unused, which);
  for (uint32_t i = 0; i < below; ++i) {
    if (depth == depth_)
      query.leaf(first + which[i], view.all[which[i]] != 0);
    else
      look(depth + 1, first + which[i], query);
  }
}

/// The sums over photons that a linear kernel needs, in floats lane by lane, and in doubles.
class MomentSums {
 public:
  /// Adds those of the nodes of a group that are marked by 1.
  void add(const NodeGroup& nodes, const NodeMoments& moments, const uint32_t* taken, const Vec3& point);
  /// Adds photons, from number `first` on, with these squared distances (m^2; kBlock of them), if nearer than the
  /// square root of `limit2`. Returns how many are.
  uint32_t add(const NodeGroups& photons, size_t first, const float* distances2, float limit2);
  /// Ends the sum.
  void finish();

  Rgbd power() const { return power_; }    // sum P, W
  Rgbd second() const { return second_; }  // sum P d^2, W m^2

 private:
  void close_block() {
    if (++blocks_ == PhotonBatch::kMost / kBlock) finish();
  }

  LaneSums powers_, seconds_;  // of as many blocks as a PhotonBatch has at the most
  size_t blocks_ = 0;
  Rgbd power_{0.0}, second_{0.0};
};

}  // namespace vpm
