// Cutting the list back to the nearest.
#include "photon/neighbours.h"

#include <algorithm>
#include <utility>

namespace vpm {

void Neighbours::start(uint32_t count, float max_radius) {
  count_ = count;
  limit_ = max_radius * max_radius;
  entries_.clear();
  entries_.reserve(2 * size_t{count});
}

void Neighbours::keep_nearest() {
  distances2_.clear();
  for (const Entry& e : entries_) distances2_.push_back(e.distance2);
  const auto kth = distances2_.begin() + (count_ - 1);
  std::nth_element(distances2_.begin(), kth, distances2_.end());
  limit_ = *kth;
  // Of those at the limit itself the first found stay, as many as make k.
  std::ptrdiff_t ties = 1 + std::count(distances2_.begin(), kth, limit_);
  std::erase_if(entries_,
                [&](const Entry& e) { return e.distance2 > limit_ || (e.distance2 == limit_ && ties-- <= 0); });
}

void Neighbours::finish() {
  if (entries_.size() < count_) return;
  keep_nearest();
  const auto farthest =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.distance2 == limit_; });
  std::rotate(entries_.begin(), farthest, farthest + 1);
}

}  // namespace vpm
