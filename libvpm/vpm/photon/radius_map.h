// The photon map for fixed radii: photons sorted into a uniform grid, found by scanning short rows of cells.
//
// The grid's cells are a radius wide unless that would make more than a cell a photon. Queries of any other
// radius are as right, and slower the less the cells fit it. Rows run along x, so that the photons of neighbouring
// cells lie side by side and distances are computed in blocks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "vpm/base/count.h"
#include "vpm/base/vec.h"
#include "vpm/photon/photon_batch.h"

namespace vpm {

class RadiusMap {
 public:
  RadiusMap() = default;
  /// Sorts the photons for queries of about `radius` (m, > 0), with powers multiplied by `scale`: 1/emitted.
  RadiusMap(const std::vector<Photon>& photons, float radius, float scale);

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
  int cell_along(int axis, float x) const {
    return std::clamp(static_cast<int>((x - bounds_.lo[axis]) * per_cell_), 0, count_[axis] - 1);
  }
  /// Fills `first_` from the photons' cells; returns the photons' numbers in the order of their cells.
  std::vector<uint32_t> sort_by_cell(const std::vector<uint32_t>& cells);

  float per_cell_ = 0.0f;  // 1/m
  Box bounds_;
  Vec3i count_{0};
  std::vector<uint32_t> first_;  // of each cell, and one past the last
  PhotonTable photons_;          // cell by cell
};

template <class Visit>
uint32_t RadiusMap::visit_near(const Vec3& point, float radius, Visit&& visit) const {
  for (int a = 0; a < 3; ++a)
    if (!(point[a] + radius >= bounds_.lo[a] && point[a] - radius <= bounds_.hi[a])) return 0;
  uint32_t visited = 0;
  NearPhotons found;
  const auto add = [&](const float* distances2, uint32_t number, uint32_t first) {
    found.add(distances2, number, first, radius * radius, visit);
  };
  const float cell = 1.0f / per_cell_;
  const int z_end = cell_along(2, point.z + radius);
  for (int z = cell_along(2, point.z - radius); z <= z_end; ++z) {
    // The nearest distance of the slab of cells to the point, less a hair for rounding; border cells hold all that lies
    // beyond.
    const auto gap = [&](int axis, int index) {
      const float lo = bounds_.lo[axis] + static_cast<float>(index) * cell;
      return std::max(0.0f, std::max(lo - point[axis], point[axis] - (lo + cell)) - 1e-3f * cell);
    };
    const float gap_z = gap(2, z);
    const float rest_z = radius * radius - gap_z * gap_z;
    if (rest_z < 0.0f) continue;
    const float reach_y = std::sqrt(rest_z);
    const int y_end = cell_along(1, point.y + reach_y);
    for (int y = cell_along(1, point.y - reach_y); y <= y_end; ++y) {
      const float gap_y = gap(1, y);
      const float rest = rest_z - gap_y * gap_y;
      if (rest < 0.0f) continue;
      const float reach_x = std::sqrt(rest);
      const size_t row = (static_cast<size_t>(z) * count_.y + y) * count_.x;
      const uint32_t begin = first_[row + cell_along(0, point.x - reach_x)];
      const uint32_t end = first_[row + cell_along(0, point.x + reach_x) + 1];
      photons_.for_each_block(begin, end, point, add);
      count(visited, end - begin);
    }
  }
  found.take(visit);
  return visited;
}

}  // namespace vpm
