// Cutting the list back to the nearest.
#include "photon/neighbours.h"

#include <algorithm>

namespace vpm {

void Neighbours::start(uint32_t count, float max_radius) {
  count_ = count;
  limit_ = max_radius * max_radius;
  size_ = 0;
  if (distances2_.size() < most() + kBlock) {
    distances2_.resize(most() + kBlock);
    photons_.resize(most() + kBlock);
  }
}

void Neighbours::keep_nearest() {
  limit_ = kth_smallest(distances2_.data(), size_, count_);
  size_t below = 0;
  for (size_t i = 0; i < size_; ++i) below += distances2_[i] < limit_ ? 1 : 0;
  // Of those at the limit itself the first found stay, as many as make k.
  size_t ties = count_ - below, kept = 0;
  for (size_t i = 0; i < size_; ++i) {
    const float distance2 = distances2_[i];
    const bool at_limit = distance2 == limit_ && ties > 0;
    if (at_limit) --ties;
    distances2_[kept] = distance2;
    photons_[kept] = photons_[i];
    kept += distance2 < limit_ || at_limit ? 1 : 0;
  }
  size_ = kept;
}

void Neighbours::finish() {
  if (size_ < count_) return;
  keep_nearest();
  const auto farthest =
      std::find(distances2_.begin(), distances2_.begin() + static_cast<std::ptrdiff_t>(size_), limit_) -
      distances2_.begin();
  std::rotate(distances2_.begin(), distances2_.begin() + farthest, distances2_.begin() + farthest + 1);
  std::rotate(photons_.begin(), photons_.begin() + farthest, photons_.begin() + farthest + 1);
}

}  // namespace vpm
