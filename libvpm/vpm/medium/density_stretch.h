// The segment of a ray in one brick of a density grid: bounds of the density on it, and the density itself.
#pragma once

#include <algorithm>

#include "vpm/base/vec.h"
#include "vpm/medium/brick_blocks.h"
#include "vpm/medium/trilinear.h"

namespace vpm {

/// A segment of a ray on which the density lies within [min, max]. If `values` is null, the density is min = max.
struct DensityStretch {
  static constexpr int kCells = 8;            // cells along a brick's edge
  static constexpr int kValues = kCells + 1;  // voxels along it: one more at the upper end, to hold all cell corners

  double t0 = 0.0, t1 = 0.0;  // m along the ray; infinite only if `values` is null
  float min = 0.0f, max = 0.0f;
  const float* values = nullptr;        // of the brick: [(z * kValues + y) * kValues + x]
  const BrickBlocks* blocks = nullptr;  // of the brick, unless `values` is null
  Vec3d origin{0.0};                    // of the ray, in cells from the brick's lower corner
  Vec3d direction{0.0};                 // of the ray, cells per metre
  bool nearest = false;                 // interpolation by the nearest voxel; else trilinear

  static_assert(kCells == BrickBlocks::kCells * BrickBlocks::kBlocks);

  bool uniform() const { return values == nullptr; }
  /// Prefetches the eight values at the corners of a cell; `values` points at the first.
  static void prefetch_cell(const float* values) {
    for (const int edge : {0, kValues, kValues * kValues, (kValues + 1) * kValues}) __builtin_prefetch(values + edge);
  }

  /// The density at t in [t0, t1]. It is clamped to [min, max], and the point to the brick, as rounding may take either
  /// slightly outside.
  float density(double t) const {
    if (uniform()) return min;
    const Vec3d p = place(t);
    const Vec3i cell = cell_at(p);
    const float* v = corner(cell);
    if (nearest) return *v;
    return std::clamp(trilinear(v, kValues, kValues * kValues, Vec3(p - Vec3d(cell))), min, max);
  }
  /// Bounds of the density at t. They are tighter than those of the whole segment, and quicker to read than the
  /// density. Also prefetches the values around t, because density() reads them next if the bounds do not suffice.
  DensityBounds bounds(double t) const {
    if (uniform()) return {min, max};
    const Vec3i cell = cell_at(place(t));
    prefetch_cell(corner(cell));
    return blocks->bounds(cell, {min, max});
  }

 private:
  /// The point at t, in units of cells from the brick's lower corner.
  Vec3d place(double t) const { return glm::clamp(origin + t * direction, 0.0, double{kCells}); }
  static Vec3i cell_at(const Vec3d& place) { return glm::min(Vec3i(place), Vec3i(kCells - 1)); }
  /// The value at the cell's lower corner.
  const float* corner(const Vec3i& cell) const { return values + (cell.z * kValues + cell.y) * kValues + cell.x; }
};

}  // namespace vpm
