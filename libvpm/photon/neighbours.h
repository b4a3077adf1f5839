// The nearest of many photons that are offered in any order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vpm {

/// Keeps the k nearest of the photons that are added. They gather in a list of up to twice as many, which is cut back
/// to the nearest k when it is full: a constant cost for each photon, where a heap's grows with k. Reused between
/// queries, so that none allocates.
class Neighbours {
 public:
  struct Entry {
    float distance2;  // m^2
    uint32_t photon;  // index in the map
  };

  /// Begins a search for the `count` >= 1 nearest within `max_radius`, m; may be infinite.
  void start(uint32_t count, float max_radius);
  /// Photons at this distance or farther, squared, cannot enter; after finish(), that of the k-th nearest, or of
  /// `max_radius` where there are not so many.
  float limit() const { return limit_; }
  /// A photon nearer than the limit.
  void add(const Entry& entry) {
    if (entries_.size() == 2 * size_t{count_}) keep_nearest();
    if (entry.distance2 < limit_) entries_.push_back(entry);
  }
  /// Ends the search: the nearest are left, the farthest of them first where there are k, the others in the order in
  /// which they were added.
  void finish();
  /// Were `count` photons found within the largest radius?
  bool full() const { return entries_.size() == count_; }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  void keep_nearest();

  uint32_t count_ = 0;
  float limit_ = 0.0f;
  std::vector<Entry> entries_;
  std::vector<float> distances2_;
};

}  // namespace vpm
