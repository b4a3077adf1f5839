// Sorting photons into leaves.
#include "vpm/photon/map/leaf_order.h"

#include <algorithm>
#include <bit>

#include "vpm/base/parallel.h"

namespace vpm {
namespace {

constexpr size_t kAlone = 1 << 15;      // parts of fewer photons are not worth a thread of their own
constexpr size_t kCopyChunk = 1 << 16;  // photons copied one after another

/// A photon on its way to its leaf.
struct Item {
  Vec3 position;
  uint32_t photon;
};

int longest_axis(const Vec3& e) { return e.x >= e.y ? (e.x >= e.z ? 0 : 2) : (e.y >= e.z ? 1 : 2); }

/// Sorts the items of the leaves [first, last), which are all that lies below a node.
void part(std::vector<Item>& items, LeafOrder& tree, size_t node, size_t first, size_t last) {
  if (last - first == 1) return;
  const size_t middle = (first + last) / 2;
  const auto at = [&](size_t leaf) {
    return items.begin() + static_cast<std::ptrdiff_t>(leaf_begin(items.size(), tree.leaves, leaf));
  };
  Box bounds;
  for (auto i = at(first); i != at(last); ++i) bounds.add(i->position);
  const int axis = longest_axis(bounds.extent());
  std::nth_element(at(first), at(middle), at(last),
                   [axis](const Item& a, const Item& b) { return a.position[axis] < b.position[axis]; });
  tree.splits[node] = {at(middle)->position[axis], static_cast<uint32_t>(axis)};
  const auto half = [&](size_t upper) {
    part(items, tree, 2 * node + upper, upper ? middle : first, upper ? last : middle);
  };
  if (static_cast<size_t>(at(last) - at(first)) < kAlone) {
    half(0);
    half(1);
  } else {
    parallel_for_chunks(2, 1, [&](size_t upper, size_t, size_t) { half(upper); });
  }
}

/// The leaves of `count` places; position_of(i) is in m.
template <class PositionOf>
LeafOrder sort_places(size_t count, size_t largest, PositionOf&& position_of) {
  LeafOrder tree;
  tree.leaves = std::bit_ceil(std::max<size_t>(1, (count + largest - 1) / largest));
  tree.splits.resize(tree.leaves);
  std::vector<Item> items(count);
  parallel_for_chunks(items.size(), kCopyChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) items[i] = {position_of(i), static_cast<uint32_t>(i)};
  });
  part(items, tree, 1, 0, tree.leaves);
  tree.order.resize(count);
  std::transform(items.begin(), items.end(), tree.order.begin(), [](const Item& item) { return item.photon; });
  return tree;
}

}  // namespace

LeafOrder sort_into_leaves(const std::vector<Photon>& photons, size_t largest) {
  return sort_places(photons.size(), largest, [&](size_t i) { return photons[i].position; });
}
LeafOrder sort_into_leaves(const std::vector<Vec3>& positions, size_t largest) {
  return sort_places(positions.size(), largest, [&](size_t i) { return positions[i]; });
}

}  // namespace vpm
