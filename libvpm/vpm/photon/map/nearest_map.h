// The photon map for k nearest neighbours: a balanced kd-tree over leaves of up to 16 photons that lie side by side.
// And the nearest of many photons that are offered in any order.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "vpm/base/below.h"
#include "vpm/base/counters.h"
#include "vpm/base/vec.h"
#include "vpm/photon/map/leaf_order.h"
#include "vpm/photon/map/node_groups.h"
#include "vpm/photon/map/photon_table.h"

namespace vpm {

/// What searches for the distance of the k-th alone (nearest_sums.h) keep between queries.
struct NodeSearch {
  float radius = 0.0f;            // that was found last, m; 0: none was
  std::vector<float> distances2;  // m^2; room for a list
};

/// Keeps the k nearest of the photons that are added. They gather in a list of up to about twice as many, which is cut
/// back to the nearest k when it is full: a constant cost for each photon, where a heap's grows with k. Reused between
/// queries, so that none allocates.
class Neighbours {
 public:
  /// Begins a search for the `count` >= 1 nearest within `max_radius`, m; may be infinite.
  void start(uint32_t count, float max_radius);
  /// Photons at this distance or farther, squared, cannot enter; after finish(), that of the k-th nearest, or of
  /// `max_radius` where there are not so many.
  float limit() const { return limit_; }
  /// Adds those of photons `first` to `first` + `number` - 1, at most kBlock, that are nearer than the limit and that
  /// accept(photon) takes.
  template <class Accept>
  void add(const float* distances2, uint32_t number, uint32_t first, Accept&& accept);
  /// Ends the search: the nearest are left, the farthest of them first where there are k, the others in the order in
  /// which they were added.
  void finish();

  size_t size() const { return size_; }
  /// Were `count` photons found within the largest radius?
  bool full() const { return size_ == count_; }
  const uint32_t* photons() const { return photons_.data(); }     // their numbers in the map
  const float* distances2() const { return distances2_.data(); }  // m^2

  NodeSearch& without_list() { return without_list_; }

 private:
  size_t most() const { return 2 * size_t{count_} + kBlock; }
  void keep_nearest();

  uint32_t count_ = 0;
  float limit_ = 0.0f;
  size_t size_ = 0;
  std::vector<float> distances2_;  // with room for two blocks behind most(): whole ones are read and written
  std::vector<uint32_t> photons_;
  NodeSearch without_list_;
};

template <class Accept>
void Neighbours::add(const float* distances2, uint32_t number, uint32_t first, Accept&& accept) {
  const size_t before = size_;
  const size_t after =
      before + append_below(distances2, number, limit_, first, &distances2_[before], &photons_[before]);
  for (size_t i = before; i < after; ++i) {
    distances2_[size_] = distances2_[i];
    photons_[size_] = photons_[i];
    size_ += accept(photons_[i]) ? 1 : 0;
  }
  if (size_ >= most()) keep_nearest();
}

class NearestMap {
 public:
  static constexpr uint32_t kMany = 512;  // neighbours, of which it pays to look at whole nodes first

  NearestMap() = default;
  /// Sorts the photons, with powers multiplied by `scale`: 1/emitted. Their numbers in the order of the map go into
  /// `numbers`, unless that is null.
  NearestMap(const std::vector<Photon>& photons, float scale, std::vector<uint32_t>* numbers = nullptr);

  /// The `count` nearest photons within `max_radius` (m; may be infinite) of `point` among those for which
  /// accept(const PackedDirection& travel, offset from `point`) holds. Returns how many photons it computed the
  /// distance of.
  template <class Accept>
  uint32_t find(const Vec3& point, uint32_t count, float max_radius, Neighbours& neighbours, Accept&& accept) const;

  /// Prepares nearest_sums() for searches of kMany and more.
  void add_nodes() { nodes_.emplace(photons_, leaves_); }
  /// Null where they were not added.
  const NodeGroups* nodes() const { return nodes_ ? &*nodes_ : nullptr; }

  const PhotonTable& photons() const { return photons_; }
  size_t size() const { return photons_.size(); }
  const Box& bounds() const { return bounds_; }
  size_t memory_bytes() const;

 private:
  static constexpr size_t kLeaf = kBlock;  // photons of a leaf, at most

  /// The nearest of the first `of_leaf` photons of each leaf, as the neighbours were started.
  template <class Accept>
  uint32_t search(const Vec3& point, size_t of_leaf, Neighbours& neighbours, Accept&& accept) const;

  size_t leaves_ = 1;
  std::vector<Split> splits_;  // numbered as LeafOrder says
  PhotonTable photons_;        // leaf by leaf
  Box bounds_;
  std::optional<NodeGroups> nodes_;
};

template <class Accept>
uint32_t NearestMap::find(const Vec3& point, uint32_t count, float max_radius, Neighbours& neighbours,
                          Accept&& accept) const {
  uint32_t visited = 0;
  if (count >= kMany && count < size()) {
    // The radius by the first photons of the leaves is good enough to look at little beyond it.
    const auto of_leaves = static_cast<uint32_t>(count * leaves_ / size());
    neighbours.start(of_leaves, max_radius);
    visited += search(point, 1, neighbours, accept);
    const float margin = 1.0f + 3.0f / std::sqrt(static_cast<float>(of_leaves));  // three standard deviations
    const float likely = std::sqrt(neighbours.limit() * margin);
    neighbours.start(count, std::min(max_radius, likely));
    visited += search(point, kLeaf, neighbours, accept);
    if (neighbours.full() || likely >= max_radius) return visited;
  }
  neighbours.start(count, max_radius);
  return visited + search(point, kLeaf, neighbours, accept);
}

template <class Accept>
uint32_t NearestMap::search(const Vec3& point, size_t of_leaf, Neighbours& neighbours, Accept&& accept) const {
  // What lies on the far side of splits waits on a stack, with how far the point is from it along each axis; depth is
  // at most 32 for 2^32 photons.
  struct Part {
    size_t node;
    Vec3 gap;
    float distance2;
  };
  Part stack[33];
  int top = 0;
  uint32_t visited = 0;
  const auto takes = [&](uint32_t i) { return accept(photons_.payload(i).travel, photons_.position(i) - point); };
  const auto add = [&](const float* distances2, uint32_t number, uint32_t first) {
    neighbours.add(distances2, number, first, takes);
  };
  for (Part part{1, Vec3(0.0f), 0.0f};; part = stack[--top]) {
    if (part.distance2 < neighbours.limit()) {
      while (part.node < leaves_) {
        const Split& split = splits_[part.node];
        __builtin_prefetch(splits_.data() + std::min(8 * part.node, leaves_));  // three levels down: one cache line
        const float across = point[split.axis] - split.at;                      // > 0: the point lies above
        const size_t near = 2 * part.node + (across > 0.0f ? 1 : 0);
        Part far{near ^ 1, part.gap, 0.0f};
        far.gap[split.axis] = across;
        far.distance2 = glm::dot(far.gap, far.gap);
        stack[top] = far;
        top += far.distance2 < neighbours.limit() ? 1 : 0;
        if (far.node >= leaves_) photons_.prefetch(leaf_begin(size(), leaves_, far.node - leaves_));
        part.node = near;
      }
      const size_t leaf = part.node - leaves_, begin = leaf_begin(size(), leaves_, leaf);
      const size_t end = std::min(begin + of_leaf, leaf_begin(size(), leaves_, leaf + 1));
      photons_.for_each_block(begin, end, point, add);
      count(visited, end - begin);
    }
    if (top == 0) break;
  }
  neighbours.finish();
  return visited;
}

}  // namespace vpm
