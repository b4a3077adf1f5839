// Shapes and directions of all magnitudes.
#pragma once

#include <cmath>

#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/surface/geometry.h"
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

/// Makes a scene too large for all of its shapes to be looked at, so that Embree's tree is asked: specks beside what
/// lies within `size` of a place, which a ray out of a thousand million meets.
inline void add_specks(Geometry& geometry, const Vec3& place, float size) {
  for (int i = 0; i < 7; ++i)
    geometry.add(SphereShape{place + size * Vec3(3.0f + 0.1f * static_cast<float>(i), 3.0f, 3.0f), 1e-4f * size});
}

}  // namespace vpm
