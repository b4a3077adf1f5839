// Shapes and directions of all magnitudes.
#pragma once

#include <cmath>

#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/surface/mesh.h"

namespace vpm {

inline float power_of_ten(Rng& rng, float lo, float hi) { return std::pow(10.0f, lo + (hi - lo) * rng.uniform()); }
inline Vec3 in_cube(Rng& rng) { return 2.0f * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.0f; }
inline TriangleMesh triangle(const Vec3& a, const Vec3& b, const Vec3& c) { return {{a, b, c}, {{0, 1, 2}}}; }

/// A direction whose cosine to `normal` is spread over magnitudes from 2e-6 to 1, on either side.
inline Vec3 grazing_direction(const Vec3& normal, Rng& rng) {
  const float cosine = power_of_ten(rng, -5.7f, 0.0f);
  const Vec3 axis = rng.uniform() < 0.5f ? normal : -normal;
  return direction_about(axis, 1.0f - cosine, 2.0f * kPi * rng.uniform());
}

}  // namespace vpm
