// Positions sorted into the leaves of a balanced binary tree [Friedman1977] without pointers. Nodes are numbered as in
// a heap: the root is 1, the children of node i are 2 i and 2 i + 1. The photons of a leaf follow from its number.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "vpm/photon/photon.h"

namespace vpm {

/// The plane that divides the photons below a node. Coordinates along `axis` are at most `at` below
/// the first child, and at least `at` below the second.
struct Split {
  float at = 0.0f;  // m
  uint32_t axis = 0;
};

struct LeafOrder {
  size_t leaves = 1;            // their number, a power of 2; they are the nodes `leaves` to 2 `leaves` - 1
  std::vector<Split> splits;    // of the nodes above the leaves, indexed by node
  std::vector<uint32_t> order;  // the photons' numbers, leaf by leaf
};

/// How many of `photons` photons in `leaves` leaves come before the leaf `leaf`.
inline size_t leaf_begin(size_t photons, size_t leaves, size_t leaf) {
  return (photons * leaf) >> std::countr_zero(leaves);
}

/// Divides the photons at medians, each time perpendicular to the longest side of the box around them, until each leaf
/// holds at most `largest`. A leaf holds at least half of that, if there are so many photons. Runs on all threads; the
/// result does not depend on their number.
LeafOrder sort_into_leaves(const std::vector<Photon>& photons, size_t largest);
/// The same of any positions, m.
LeafOrder sort_into_leaves(const std::vector<Vec3>& positions, size_t largest);

}  // namespace vpm
