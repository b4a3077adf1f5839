// Looking a density grid up at points. The end of density_grid.h, which is what others include.
#pragma once

#include <algorithm>

#include "vpm/medium/grid/density_grid.h"
#include "vpm/medium/grid/density_stretch.h"

namespace vpm {

[[gnu::always_inline]] inline DensityGrid::Place DensityGrid::find(const Vec3d& p) const {
  const bool inside = (p.x >= 0.0) & (p.y >= 0.0) & (p.z >= 0.0) & (p.x < lattice_size_.x) & (p.y < lattice_size_.y) &
                      (p.z < lattice_size_.z);
  if (!inside) return {frame_.background, nullptr, Vec3(0.0f)};
  // From the corner of the bricks on nothing is negative: cells and bricks are cut off, not rounded down.
  const Vec3i cell(p);
  const Vec3i b = cell >> kCellBits;
  return place_in(bricks_[(static_cast<size_t>(b.z) * brick_count_.y + b.y) * brick_count_.x + b.x], p, cell);
}

[[gnu::always_inline]] inline DensityGrid::Place DensityGrid::place_in(const Brick& brick, const Vec3d& p,
                                                                       const Vec3i& cell) const {
  const Vec3i c = cell & (kCells - 1);
  const float* values = brick.uniform() ? nullptr : values_of(brick) + (c.z * kValues + c.y) * kValues + c.x;
  return {brick.min, values, Vec3(p - Vec3d(cell))};
}

[[gnu::always_inline]] inline float DensityGrid::density_at(const Vec3d& p) const {
  if (!boxes_.whole()) [[unlikely]]
    return density_in_boxes(p);
  const Place place = find(p);
  return place.values ? read(place) : place.density;
}

[[gnu::always_inline]] inline float DensityGrid::read(const Place& place) const {
  if (frame_.interpolation == Interpolation::nearest) return *place.values;
  return std::max(0.0f, trilinear(place.values, kValues, kValues * kValues, place.fraction));
}

}  // namespace vpm
