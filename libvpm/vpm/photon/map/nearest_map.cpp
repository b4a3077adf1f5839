// Building the kd-tree, and cutting the list of neighbours back to the nearest.
#include "vpm/photon/map/nearest_map.h"

#include <algorithm>

namespace vpm {

void Neighbours::start(uint32_t count, float max_radius) {
  count_ = count;
  limit_ = max_radius * max_radius;
  size_ = 0;
  if (distances2_.size() < most() + 2 * kBlock) {
    distances2_.resize(most() + 2 * kBlock);
    photons_.resize(most() + 2 * kBlock);
  }
}

void Neighbours::keep_nearest() {
  limit_ = kth_smallest(distances2_.data(), size_, count_);
  size_ = keep_up_to(distances2_.data(), photons_.data(), size_, limit_);
  // Of those at the limit itself the first found stay, as many as make k.
  for (size_t i = size_; size_ > count_;) {
    if (distances2_[--i] != limit_) continue;
    std::copy(&distances2_[i + 1], &distances2_[size_], &distances2_[i]);
    std::copy(&photons_[i + 1], &photons_[size_], &photons_[i]);
    --size_;
  }
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

NearestMap::NearestMap(const std::vector<Photon>& photons, float scale, std::vector<uint32_t>* numbers) {
  LeafOrder tree = sort_into_leaves(photons, kLeaf);
  leaves_ = tree.leaves;
  splits_ = std::move(tree.splits);
  photons_ = PhotonTable(photons, tree.order, scale);
  bounds_ = bounds_of(photons);
  if (numbers) *numbers = std::move(tree.order);
}

size_t NearestMap::memory_bytes() const {
  const size_t nodes = nodes_ ? nodes_->memory_bytes() : 0;
  return sizeof(*this) + splits_.capacity() * sizeof(Split) + photons_.memory_bytes() + nodes;
}

}  // namespace vpm
