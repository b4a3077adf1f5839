// The density along a ray within one brick of a grid: where it is looked up, where it is bounded, and where it is a
// polynomial.
#pragma once

#include <algorithm>
#include <cmath>

#include "vpm/base/vec.h"
#include "vpm/medium/grid/brick_blocks.h"

namespace vpm {

/// The value at `f`, each of [0, 1], between the eight values around: values[z * slice + y * row + x], x, y and z of
/// {0, 1}. It rounds: among equal values it may leave them by some units in the last place.
[[gnu::always_inline]] inline float trilinear(const float* values, int row, int slice, const Vec3& f) {
  const auto along_x = [&](const float* edge) __attribute__((always_inline)) {
    return edge[0] + f.x * (edge[1] - edge[0]);
  };
  const auto along_y = [&](const float* face) __attribute__((always_inline)) {
    const float a = along_x(face);
    return a + f.y * (along_x(face + row) - a);
  };
  const float a = along_y(values);
  return a + f.z * (along_y(values + slice) - a);
}

// The density along a short segment of a ray. It is a cubic polynomial, so its density integral is exactly a quartic.

/// Density on [t0, t1] metres along a ray as the polynomial c0 + c1 s + c2 s^2 + c3 s^3 in s = t - t0. Inside one cell
/// a trilinear field is exactly that.
struct DensityPiece {
  double t0 = 0.0;  // m
  double t1 = 0.0;  // m
  double c0 = 0.0, c1 = 0.0, c2 = 0.0, c3 = 0.0;

  [[gnu::always_inline]] double length() const { return t1 - t0; }  // infinite only where uniform()
  [[gnu::always_inline]] bool uniform() const { return c1 == 0.0 && c2 == 0.0 && c3 == 0.0; }
  [[gnu::always_inline]] double density(double s) const { return c0 + s * (c1 + s * (c2 + s * c3)); }
  /// The density integral from t0 to t0 + s, m (times sigma_t: optical depth). Densities are not negative, so neither
  /// is the integral, except by rounding.
  [[gnu::always_inline]] double integral(double s) const {
    return uniform() ? s * c0 : s * (c0 + s * (c1 / 2 + s * (c2 / 3 + s * (c3 / 4))));
  }
  [[gnu::always_inline]] double integral() const { return integral(length()); }

  /// The s in [0, length()] at which integral(s) reaches `target`, 0 <= target <= integral(). Uses Newton's iteration
  /// inside a shrinking bracket, because the density may vanish at corners of a cell.
  [[gnu::always_inline]] double invert(double target) const {
    if (uniform()) return c0 > 0.0 ? std::min(target / c0, length()) : length();
    double lo = 0.0;
    double hi = length();
    double s = hi * std::clamp(target / integral(), 0.0, 1.0);
    for (int i = 0; i < kMaxIterations; ++i) {
      const double excess = integral(s) - target;
      (excess > 0.0 ? hi : lo) = s;
      const double slope = density(s);
      double next = slope > 0.0 ? s - excess / slope : -1.0;
      if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
      if (std::abs(next - s) <= 1e-12 * length()) return next;
      s = next;
    }
    return s;
  }

 private:
  /// Bisection alone would need 40 iterations to reach the tolerance. Each failed Newton step costs one iteration.
  static constexpr int kMaxIterations = 80;
};

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
  [[gnu::always_inline]] float density(double t) const {
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
