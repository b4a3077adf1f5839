// Photons sorted into the leaves of a balanced binary tree [Friedman1977], without pointers: nodes are numbered as in a
// heap, the root 1, the children of i 2 i and 2 i + 1; what lies in a leaf follows from its number.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "vpm/photon/photon.h"

namespace vpm {

/// Where the photons below a node are parted: those of its first child lie at most here, the others at least.
struct Split {
  float at = 0.0f;  // m
  uint32_t axis = 0;
};

struct LeafOrder {
  size_t leaves = 1;            // a power of 2; they are nodes `leaves` to 2 `leaves` - 1
  std::vector<Split> splits;    // of the nodes above
  std::vector<uint32_t> order;  // of the photons, leaf by leaf
};

/// Of that many photons in that many leaves, how many lie before a leaf.
inline size_t leaf_begin(size_t photons, size_t leaves, size_t leaf) {
  return (photons * leaf) >> std::countr_zero(leaves);
}

/// Parts the photons at medians, each time across the longest side of what is parted, until leaves hold at most
/// `largest`: half of that at least, where there are so many. On all threads, and the same on however many.
LeafOrder sort_into_leaves(const std::vector<Photon>& photons, size_t largest);

}  // namespace vpm
