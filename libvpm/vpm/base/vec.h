// Vectors, colours, rays and boxes: thin names over GLM.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace vpm {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec3d = glm::dvec3;
using Vec3i = glm::ivec3;
using Mat3d = glm::dmat3;
using Mat4d = glm::dmat4;

/// A quantity per colour channel (linear sRGB primaries). Its unit is given where it is declared.
using Rgb = glm::vec3;
using Rgbd = glm::dvec3;
static_assert(sizeof(Vec3) == 12 && sizeof(Vec3d) == 24,
              "the library is built with packed vectors: include it without GLM_FORCE_DEFAULT_ALIGNED_GENTYPES");

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr double kPiD = 3.14159265358979323846;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A half line. `direction` has unit length and is the direction in which light or the path from the eye travels.
struct Ray {
  Vec3 origin{0.0f};                 // m
  Vec3 direction{0.0f, 0.0f, 1.0f};  // unit

  /// The point `t` metres along the ray.
  Vec3 at(float t) const { return origin + t * direction; }
};

/// The segment [t0, t1] of a ray, in metres from its origin.
struct Interval {
  float t0 = 0.0f;
  float t1 = kInfinity;

  bool empty() const { return !(t1 > t0); }
  float length() const { return t1 - t0; }
};

/// An axis-aligned box; empty (lo > hi) until something is added.
struct Box {
  Vec3 lo{kInfinity};
  Vec3 hi{-kInfinity};

  bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
  Vec3 center() const { return 0.5f * (lo + hi); }
  Vec3 extent() const { return hi - lo; }
  float diagonal() const { return empty() ? 0.0f : glm::length(extent()); }
  bool contains(const Vec3& p) const {
    return p.x >= lo.x && p.y >= lo.y && p.z >= lo.z && p.x <= hi.x && p.y <= hi.y && p.z <= hi.z;
  }
  void add(const Vec3& p) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  void add(const Box& b) {
    lo = glm::min(lo, b.lo);
    hi = glm::max(hi, b.hi);
  }
};

inline float max_channel(const Rgb& c) { return std::max(c.r, std::max(c.g, c.b)); }
inline float sum_channels(const Rgb& c) { return c.r + c.g + c.b; }
inline float mean_channel(const Rgb& c) { return sum_channels(c) / 3.0f; }
inline bool is_grey(const Rgb& c) { return c.r == c.g && c.g == c.b; }
inline bool is_black(const Rgb& c) { return c.r == 0.0f && c.g == 0.0f && c.b == 0.0f; }
inline bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Two unit vectors that form a right-handed orthonormal frame with the unit vector `n`
/// [Duff2017, listing 3].
[[gnu::always_inline]] inline void make_frame(const Vec3& n, Vec3& s, Vec3& t) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  s = Vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
  t = Vec3(b, sign + n.y * n.y * a, -n.y);
}

}  // namespace vpm
