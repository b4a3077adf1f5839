// The photon map for fixed radii: photons sorted into a uniform grid, found by scanning short rows of cells.
//
// The grid's cells are a radius wide. Where those would be more than there are photons, they are two radii wide at the
// most, and cells far apart share a list of photons (CellLists): so a few photons far away cost nothing, and a plane
// of photons has cells as fine as a ball of them. Queries of any other radius are as right, and slower the less the
// cells fit it. Rows run along x, so that the photons of neighbouring cells lie side by side and distances are computed
// in blocks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vpm/base/counters.h"
#include "vpm/base/vec.h"
#include "vpm/photon/map/photon_batch.h"

namespace vpm {

/// Which list the photons of a cell are in, where a grid may have more cells than there are lists.
///
/// A grid with a cell of its own for each list has wide cells where a few photons lie far away. So cells keep their
/// size, and cells far apart share a list, as in spatial hashing [Teschner2003]: who scans a list for one of its cells
/// finds photons of others, too, which are in the mean no more than photons over lists. The rule is linear. So cells
/// side by side along x have lists side by side, and cells near each other never share one.
///
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

class RadiusMap {
 public:
  RadiusMap() = default;
  /// Sorts the photons for queries of about `radius` (m, > 0), with powers multiplied by `scale`: 1/emitted. Their
  /// numbers in the order of the map go into `numbers`, unless that is null.
  RadiusMap(const std::vector<Photon>& photons, float radius, float scale, std::vector<uint32_t>* numbers = nullptr);

  /// Calls visit(NearPhotons&) for the photons nearer to `point` than `radius`, m, so many at a time, in a fixed order.
  /// Returns how many photons it computed the distance of.
  template <class Visit>
  uint32_t visit_near(const Vec3& point, float radius, Visit&& visit) const;

  const PhotonTable& photons() const { return photons_; }
  size_t size() const { return photons_.size(); }
  /// The box around the photons.
  const Box& bounds() const { return bounds_; }
  size_t memory_bytes() const;

 private:
  /// Coordinates beyond the bounds count to the cells at the border.
  int cell_along(int axis, float x) const {
    return static_cast<int>(std::clamp((x - bounds_.lo[axis]) * per_cell_, 0.0f, last_[axis]));
  }
  Vec3i cell_at(const Vec3& p) const { return {cell_along(0, p.x), cell_along(1, p.y), cell_along(2, p.z)}; }
  /// Fills `first_` from the photons' lists; returns the photons' numbers in the order of their lists.
  std::vector<uint32_t> sort_by_list(const std::vector<uint32_t>& lists);

  /// Calls scan(first list, one past the last) for the rows of cells that the ball reaches.
  template <class Scan>
  void scan_rows(const Vec3& point, float radius, Scan&& scan) const;

  float per_cell_ = 0.0f;  // 1/m
  float slack_ = 0.0f;     // m; photons may lie so far outside their cells, for rounding
  float widest_ = 0.0f;    // m: within larger radii cells may share a list, which is to be scanned only once
  Box bounds_;
  Vec3 last_{0.0f};  // number of the last cell along each axis
  CellLists lists_;
  std::vector<uint32_t> first_;  // of each list, and one past the last
  PhotonTable photons_;          // list by list
};

template <class Scan>
void RadiusMap::scan_rows(const Vec3& point, float radius, Scan&& scan) const {
  const float cell = 1.0f / per_cell_;
  const Vec3 offset = point - bounds_.lo;
  // The nearest distance of the slab of cells to the point.
  const auto gap = [&](int axis, int index) {
    const float inside = offset[axis] - static_cast<float>(index) * cell;
    return std::max(0.0f, std::max(-inside, inside - cell) - slack_);
  };
  const int z_last = cell_along(2, point.z + radius);
  for (int z = cell_along(2, point.z - radius); z <= z_last; ++z) {
    const float gap_z = gap(2, z);
    const float rest_z = radius * radius - gap_z * gap_z;
    if (rest_z < 0.0f) continue;
    const float reach_y = std::sqrt(rest_z);
    const int y_last = cell_along(1, point.y + reach_y);
    for (int y = cell_along(1, point.y - reach_y); y <= y_last; ++y) {
      const float gap_y = gap(1, y);
      const float rest = rest_z - gap_y * gap_y;
      if (rest < 0.0f) continue;
      const float reach_x = std::sqrt(rest);
      const int x = cell_along(0, point.x - reach_x), x_last = cell_along(0, point.x + reach_x);
      size_t from = lists_.list_of({x, y, z}), to = from + static_cast<size_t>(x_last - x) + 1;
      for (; to > lists_.number(); from = 0, to -= lists_.number()) scan(from, lists_.number());
      scan(from, to);
    }
  }
}

template <class Visit>
uint32_t RadiusMap::visit_near(const Vec3& point, float radius, Visit&& visit) const {
  for (int a = 0; a < 3; ++a)
    if (!(point[a] + radius >= bounds_.lo[a] && point[a] - radius <= bounds_.hi[a])) return 0;
  uint32_t visited = 0;
  NearPhotons found;
  const auto add = [&](const float* distances2, uint32_t number, uint32_t first) {
    found.add(distances2, number, first, radius * radius, visit);
  };
  const auto scan = [&](size_t from, size_t to) {
    photons_.for_each_block(first_[from], first_[to], point, add);
    count(visited, first_[to] - first_[from]);
  };
  if (radius <= widest_)
    scan_rows(point, radius, scan);
  else
    scan(0, lists_.number());
  found.take(visit);
  return visited;
}

}  // namespace vpm
