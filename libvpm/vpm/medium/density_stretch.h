// The part of a ray that lies in one brick of a density grid: bounds of the density there, and the density itself.
#pragma once

#include <algorithm>

#include "vpm/base/vec.h"
#include "vpm/medium/brick_blocks.h"
#include "vpm/medium/trilinear.h"

namespace vpm {

/// A stretch of a ray on which the density keeps within [min, max]; where it has no values it is both.
struct DensityStretch {
  static constexpr int kCells = 8;            // cells along a brick's edge
  static constexpr int kValues = kCells + 1;  // voxels along it: one more on the upper side, so a cell never leaves it

  double t0 = 0.0, t1 = 0.0;  // m along the ray; infinite only without values
  float min = 0.0f, max = 0.0f;
  const float* values = nullptr;        // of the brick: [(z * kValues + y) * kValues + x]
  const BrickBlocks* blocks = nullptr;  // of the brick, where it has values
  Vec3d origin{0.0};                    // of the ray, in cells from the brick's lower corner
  Vec3d direction{0.0};                 // of the ray, cells per metre
  bool nearest = false;                 // the interpolation; else trilinear

  static_assert(kCells == BrickBlocks::kCells * BrickBlocks::kBlocks);

  bool uniform() const { return values == nullptr; }
  /// Starts to fetch the eight values of a cell, of which the first is given.
  static void prefetch_cell(const float* values) {
    for (const int edge : {0, kValues, kValues * kValues, (kValues + 1) * kValues}) __builtin_prefetch(values + edge);
  }

  /// The density at t in [t0, t1]; never outside its bounds, which rounding may leave by a hair, as it may the brick.
  float density(double t) const {
    if (uniform()) return min;
    const Vec3d p = place(t);
    const Vec3i cell = cell_at(p);
    const float* v = corner(cell);
    if (nearest) return *v;
    return std::clamp(trilinear(v, kValues, kValues * kValues, Vec3(p - Vec3d(cell))), min, max);
  }
  /// Bounds of the density at t that are closer than those of the whole stretch, and quicker to read than the density.
  /// Starts to fetch the values around t, which are read next where the bounds leave it open what the density is.
  DensityBounds bounds(double t) const {
    if (uniform()) return {min, max};
    const Vec3i cell = cell_at(place(t));
    prefetch_cell(corner(cell));
    return blocks->bounds(cell, {min, max});
  }

 private:
  /// In cells from the brick's lower corner.
  Vec3d place(double t) const { return glm::clamp(origin + t * direction, 0.0, double{kCells}); }
  static Vec3i cell_at(const Vec3d& place) { return glm::min(Vec3i(place), Vec3i(kCells - 1)); }
  /// The value at the cell's lower corner.
  const float* corner(const Vec3i& cell) const { return values + (cell.z * kValues + cell.y) * kValues + cell.x; }
};

}  // namespace vpm
