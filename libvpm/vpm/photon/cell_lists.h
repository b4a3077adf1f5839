// Which list the photons of a cell are in, where a grid may have more cells than there are lists.
//
// A grid with a cell of its own for each list has wide cells where a few photons lie far away. So cells keep their
// size, and cells far apart share a list, as in spatial hashing [Teschner2003]: who scans a list for one of its cells
// finds photons of others, too, which are in the mean no more than photons over lists. The rule is linear. So cells
// side by side along x have lists side by side, and cells near each other never share one.
#pragma once

#include <cstddef>
#include <cstdint>

#include "vpm/base/vec.h"

namespace vpm {

/// The list of cell (x, y, z) is x + `stride_y` y + `stride_z` z modulo the number of lists.
class CellLists {
 public:
  CellLists() = default;
  /// So many cells along each axis, at least 1, in at most `most` >= 1 lists: a list each where there are enough.
  CellLists(const Vec3d& cells, double most);

  /// The list of a cell. Those of the cells after it along x follow in order; list 0 follows the last.
  size_t list_of(const Vec3i& cell) const {
    const uint64_t place = static_cast<uint64_t>(cell.x) + stride_y_ * static_cast<uint64_t>(cell.y) +
                           stride_z_ * static_cast<uint64_t>(cell.z);
    return place < number_ ? place : place % number_;
  }
  size_t number() const { return number_; }  // of lists
  /// No two cells of a box of so many cells along each axis share a list.
  const Vec3i& window() const { return window_; }

 private:
  uint64_t stride_y_ = 1, stride_z_ = 1, number_ = 1;
  Vec3i window_{1};
};

}  // namespace vpm
