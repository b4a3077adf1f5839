// Building the kd-tree: split at the median across the longest side of each part's bounds, both halves at once.
#include "photon/nearest_map.h"

#include <algorithm>
#include <bit>

#include "base/parallel.h"

namespace vpm {
namespace {

constexpr size_t kAlone = 1 << 15;  // parts of fewer photons are not worth a thread of their own
constexpr size_t kChunk = 1 << 16;  // photons copied one after another

/// A photon on its way to its leaf.
struct Item {
  Vec3 position;
  uint32_t photon;
};

int longest_axis(const Vec3& e) { return e.x >= e.y ? (e.x >= e.z ? 0 : 2) : (e.y >= e.z ? 1 : 2); }

/// Sorts the items of the leaves [first, last) below a node; leaf l begins at begin(l).
template <class Split, class Begin>
void split(std::vector<Item>& items, std::vector<Split>& splits, const Begin& begin, size_t node, size_t first,
           size_t last) {
  if (last - first == 1) return;
  const size_t middle = (first + last) / 2;
  const auto at = [&](size_t leaf) { return items.begin() + static_cast<std::ptrdiff_t>(begin(leaf)); };
  Box bounds;
  for (auto i = at(first); i != at(last); ++i) bounds.add(i->position);
  const int axis = longest_axis(bounds.extent());
  std::nth_element(at(first), at(middle), at(last),
                   [axis](const Item& a, const Item& b) { return a.position[axis] < b.position[axis]; });
  splits[node] = {at(middle)->position[axis], static_cast<uint32_t>(axis)};
  const auto half = [&](size_t upper) {
    split(items, splits, begin, 2 * node + upper, upper ? middle : first, upper ? last : middle);
  };
  if (begin(last) - begin(first) < kAlone) {
    half(0);
    half(1);
  } else {
    parallel_for_chunks(2, 1, [&](size_t upper, size_t, size_t) { half(upper); });
  }
}

}  // namespace

NearestMap::NearestMap(const std::vector<Photon>& photons, float scale)
    : leaves_(std::bit_ceil(std::max<size_t>(1, (photons.size() + kLeaf - 1) / kLeaf))),
      splits_(leaves_),
      photons_(photons.size()) {
  std::vector<Item> items(photons.size());
  for (size_t i = 0; i < photons.size(); ++i) {
    items[i] = {photons[i].position, static_cast<uint32_t>(i)};
    bounds_.add(photons[i].position);
  }
  split(
      items, splits_, [&](size_t leaf) { return leaf_begin(leaf); }, 1, 0, leaves_);
  parallel_for_chunks(items.size(), kChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) photons_.set(i, photons[items[i].photon], scale);
  });
}

size_t NearestMap::memory_bytes() const {
  return sizeof(*this) + splits_.capacity() * sizeof(Split) + photons_.memory_bytes();
}

}  // namespace vpm
