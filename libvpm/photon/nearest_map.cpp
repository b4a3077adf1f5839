// Balancing and searching the kd-tree.
#include "photon/nearest_map.h"

#include <algorithm>
#include <bit>

namespace vpm {
namespace {

bool nearer(const Neighbours::Entry& a, const Neighbours::Entry& b) { return a.distance2 < b.distance2; }

/// The size of the left subtree of a left-balanced tree of n nodes.
size_t left_size(size_t n) {
  const size_t full = std::bit_floor(n + 1) - 1;  // nodes of the complete levels
  const size_t last = n - full;                   // on the level below
  return (full - 1) / 2 + std::min(last, (full + 1) / 2);
}

int longest_axis(const Vec3& e) { return e.x >= e.y ? (e.x >= e.z ? 0 : 2) : (e.y >= e.z ? 1 : 2); }

}  // namespace

void Neighbours::add(const Entry& entry) {
  if (full()) {
    std::pop_heap(heap_.begin(), heap_.end(), nearer);
    heap_.back() = entry;
  } else {
    heap_.push_back(entry);
  }
  std::push_heap(heap_.begin(), heap_.end(), nearer);
  if (full()) limit_ = heap_.front().distance2;
}

NearestMap::NearestMap(std::vector<Photon> photons, float scale) {
  for (Photon& p : photons) {
    bounds_.add(p.position);
    p.power *= scale;
  }
  tree_.resize(photons.size());
  axis_.resize(photons.size());
  if (!photons.empty()) balance(photons, 0, photons.size(), 0, bounds_);
}

void NearestMap::balance(std::vector<Photon>& photons, size_t begin, size_t end, size_t node, const Box& box) {
  const size_t median = begin + left_size(end - begin);
  const int axis = longest_axis(box.extent());
  const auto at = [&](size_t i) { return photons.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(median), at(end),
                   [axis](const Photon& a, const Photon& b) { return a.position[axis] < b.position[axis]; });
  tree_[node] = photons[median];
  axis_[node] = static_cast<uint8_t>(axis);
  const float split = photons[median].position[axis];
  Box lower = box, upper = box;
  lower.hi[axis] = split;
  upper.lo[axis] = split;
  if (median > begin) balance(photons, begin, median, 2 * node + 1, lower);
  if (end > median + 1) balance(photons, median + 1, end, 2 * node + 2, upper);
}

size_t NearestMap::memory_bytes() const { return sizeof(*this) + tree_.capacity() * sizeof(Photon) + axis_.capacity(); }

}  // namespace vpm
