// The part of a ray that lies in one brick of a density grid: bounds of the density there, and the density itself.
#pragma once

#include <algorithm>

#include "base/vec.h"
#include "medium/trilinear.h"

namespace vpm {

/// A stretch of a ray on which the density keeps within [min, max]; where it has no values it is both.
struct DensityStretch {
  static constexpr int kCells = 8;            // cells along a brick's edge
  static constexpr int kValues = kCells + 1;  // voxels along it: one more on the upper side, so a cell never leaves it

  double t0 = 0.0, t1 = 0.0;  // m along the ray; infinite only without values
  float min = 0.0f, max = 0.0f;
  const float* values = nullptr;  // of the brick: [(z * kValues + y) * kValues + x]
  Vec3d origin{0.0};              // of the ray, in cells from the brick's lower corner
  Vec3d direction{0.0};           // of the ray, cells per metre
  bool nearest = false;           // the interpolation; else trilinear

  bool uniform() const { return values == nullptr; }

  /// The density at t in [t0, t1]; never outside its bounds, which rounding may leave by a hair, as it may the brick.
  float density(double t) const {
    if (uniform()) return min;
    const Vec3d p = glm::clamp(origin + t * direction, 0.0, double{kCells});
    const Vec3i cell = glm::min(Vec3i(p), Vec3i(kCells - 1));
    const float* v = values + (cell.z * kValues + cell.y) * kValues + cell.x;
    if (nearest) return *v;
    return std::clamp(trilinear(v, kValues, kValues * kValues, Vec3(p - Vec3d(cell))), min, max);
  }
};

}  // namespace vpm
