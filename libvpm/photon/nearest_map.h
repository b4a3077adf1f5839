// The photon map for k nearest neighbours: a left-balanced kd-tree laid out as a heap, without pointers [Jensen2001,
// ch. 6].
#pragma once

#include <cstdint>
#include <vector>

#include "base/count.h"
#include "base/vec.h"
#include "photon/photon.h"

namespace vpm {

/// The photons a k-nearest query found: a bounded max-heap on the squared distance. Reused between queries, so that no
/// query allocates.
class Neighbours {
 public:
  struct Entry {
    float distance2;  // m^2
    uint32_t photon;  // for NearestMap::photon()
  };

  explicit Neighbours(uint32_t count) { reserve(count); }
  /// Makes room for the `count` nearest.
  void reserve(uint32_t count) {
    count_ = count;
    heap_.reserve(count);
  }
  void clear(float max_radius) {
    heap_.clear();
    limit_ = max_radius * max_radius;
  }
  /// Photons farther than this, squared, cannot enter.
  float limit() const { return limit_; }
  void add(const Entry& entry);
  /// Were `count` photons found within the largest radius?
  bool full() const { return heap_.size() == count_; }
  const std::vector<Entry>& entries() const { return heap_; }

 private:
  uint32_t count_ = 0;
  float limit_ = 0.0f;
  std::vector<Entry> heap_;
};

class NearestMap {
 public:
  NearestMap() = default;
  /// Balances the photons, with powers multiplied by `scale`: 1/emitted.
  NearestMap(std::vector<Photon> photons, float scale);

  /// The k nearest photons within `max_radius` (m; may be infinite) of `point` among those for which accept(const
  /// Photon&, offset from `point`) holds, k as the neighbours were made for. When full, the farthest is at
  /// sqrt(limit()). Returns how many photons it computed the distance of.
  template <class Accept>
  uint32_t find(const Vec3& point, float max_radius, Neighbours& neighbours, Accept&& accept) const;

  const Photon& photon(uint32_t i) const { return tree_[i]; }
  size_t size() const { return tree_.size(); }
  const Box& bounds() const { return bounds_; }
  size_t memory_bytes() const;

 private:
  void balance(std::vector<Photon>& photons, size_t begin, size_t end, size_t node, const Box& box);

  std::vector<Photon> tree_;   // children of node i: 2 i + 1 and 2 i + 2
  std::vector<uint8_t> axis_;  // that splits at node i
  Box bounds_;
};

template <class Accept>
uint32_t NearestMap::find(const Vec3& point, float max_radius, Neighbours& neighbours, Accept&& accept) const {
  neighbours.clear(max_radius);
  // Far children wait on a stack with the squared distance of their plane; depth is at most 32 for 2^32 photons.
  struct Waiting {
    size_t node;
    float distance2;
  };
  Waiting stack[64];
  int top = 0;
  uint32_t visited = 0;
  size_t node = 0;
  for (;;) {
    for (; node < tree_.size(); count(visited)) {
      const Photon& p = tree_[node];
      const Vec3 offset = p.position - point;
      const float d2 = glm::dot(offset, offset);
      if (d2 < neighbours.limit() && accept(p, offset)) neighbours.add({d2, static_cast<uint32_t>(node)});
      const float across = -offset[axis_[node]];  // > 0: the point lies on the upper side
      const size_t near = 2 * node + (across > 0.0f ? 2 : 1);
      stack[top++] = {4 * node + 3 - near, across * across};
      node = near;
    }
    do {
      if (top == 0) return visited;
      node = stack[--top].node;
    } while (stack[top].distance2 >= neighbours.limit() || node >= tree_.size());
  }
}

}  // namespace vpm
