// A ray's search for what it meets first, among what may be met.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>

#include "vpm/surface/locate.h"

namespace vpm {

/// How much further than a distance Embree is to look, relative to it and to the scene's size, so that the rounding of
/// its own distances leaves nothing out: 64 times the spacing of floats in [1, 2).
inline constexpr float kBeyond = 0x1p-17f;

/// A ray's search for the nearest hit. Which hit that is is decided here, so that it is the same on any processor:
/// where Embree brings what the ray may meet, its own distances only say how far it looks. Of hits at one distance the
/// nearest is that of the shape added first.
struct Query {
  const Ray& ray;
  float t_max;                   // m
  float size;                    // m: of the scene and the ray's origin
  std::span<const Hit> without;  // their shapes are left out
  float limit;                   // m: how far Embree is to look, never more than before
  // The nearest so far:
  Crossing nearest{};
  float t = kInfinity;  // m: rounded, as distances are compared
  uint32_t shape = ~0u, triangle = 0;
  float others = kInfinity;  // m: no other shape is met before

  Query(const Ray& a_ray, float a_t_max, float scene_size, std::span<const Hit> left_out)
      : ray(a_ray),
        t_max(a_t_max),
        size(scene_size + std::abs(a_ray.origin.x) + std::abs(a_ray.origin.y) + std::abs(a_ray.origin.z)),
        without(left_out),
        limit(t_max + kBeyond * (t_max + size)) {}

  bool leaves_out(uint32_t candidate) const {
    for (const Hit& hit : without)
      if (hit.shape == candidate) return true;
    return false;
  }
  /// Takes a crossing if it is nearer than all before.
  bool take(const Crossing& met, uint32_t of_shape, uint32_t of_triangle) {
    const auto at = static_cast<float>(met.t);
    if (!(at >= kMinT)) return false;
    const bool nearer = at < t_max && std::tie(at, of_shape, of_triangle) < std::tie(t, shape, triangle);
    if (of_shape != shape) others = std::min(others, nearer ? t : at);
    if (!nearer) return false;
    nearest = met, t = at, shape = of_shape, triangle = of_triangle;
    // As far as what coincides with it may seem to be.
    limit = std::min(limit, t + kBeyond * (t + size) * std::abs(static_cast<float>(met.inverse_cosine)));
    return true;
  }
};

}  // namespace vpm
