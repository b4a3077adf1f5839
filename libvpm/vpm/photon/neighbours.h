// The nearest of many photons that are offered in any order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vpm/base/below.h"

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

}  // namespace vpm
