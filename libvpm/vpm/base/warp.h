// Warps of uniform numbers in [0, 1)^2 to discs, cones, spheres and hemispheres. Each states its density.
#pragma once

#include <algorithm>
#include <cmath>

#include "vpm/base/vec.h"

namespace vpm {

/// A direction uniform over the sphere; density 1/(4 pi) 1/sr.
inline Vec3 uniform_sphere(const Vec2& u) {
  const float z = 1.0f - 2.0f * u.x;
  const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
  const float phi = 2.0f * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// The angle of the point (x, y) in turns, in [-1/2, 1/2]. In double, as C libraries of different years round float's
/// atan2, asin, log1p and expm1 differently.
inline float turns_of(float y, float x) { return static_cast<float>(std::atan2(double{y}, double{x}) / (2.0 * kPiD)); }

/// The `u` of which uniform_sphere() makes that direction (unit), in [0, 1]^2.
inline Vec2 uniform_sphere_numbers(const Vec3& direction) {
  const float turns = turns_of(direction.y, direction.x);
  return {std::clamp(0.5f * (1.0f - direction.z), 0.0f, 1.0f), turns < 0.0f ? turns + 1.0f : turns};
}

/// A point uniform over the unit disc; density 1/pi.
inline Vec2 uniform_disc(const Vec2& u) {
  const float r = std::sqrt(u.x);
  const float phi = 2.0f * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi)};
}

/// A direction about the unit vector `n`, density cos/pi 1/sr.
inline Vec3 cosine_hemisphere(const Vec3& n, const Vec2& u) {
  const Vec2 d = uniform_disc(u);
  const float z = std::sqrt(std::max(0.0f, 1.0f - u.x));
  Vec3 s, t;
  make_frame(n, s, t);
  return glm::normalize(d.x * s + d.y * t + z * n);
}

/// The direction at azimuth `phi` and polar angle theta about the unit vector `axis`, given `away` = 1 - cos(theta):
/// the difference keeps narrow angles exact.
inline Vec3 direction_about(const Vec3& axis, float away, float phi) {
  const float sin_theta = std::sqrt(std::max(0.0f, away * (2.0f - away)));
  Vec3 s, t;
  make_frame(axis, s, t);
  return glm::normalize(sin_theta * (std::cos(phi) * s + std::sin(phi) * t) + (1.0f - away) * axis);
}

/// A direction uniform over the cone about `axis` with `away` = 1 - cos(half angle); density 1/(2 pi away) 1/sr.
inline Vec3 uniform_cone(const Vec3& axis, float away, const Vec2& u) {
  return direction_about(axis, u.x * away, 2.0f * kPi * u.y);
}

}  // namespace vpm
