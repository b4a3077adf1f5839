// Numbers side by side that each operator takes all at once.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "vpm/base/below.h"
#include "vpm/base/vec.h"

namespace vpm {

/// kBlock numbers. The compiler has +, <, ?: and the like on them, by as many instructions as the machine needs, and
/// keeps them in registers, where loops over arrays go through memory.
using Floats = float __attribute__((vector_size(kBlock * sizeof(float))));
using LaneMask = int32_t __attribute__((vector_size(kBlock * sizeof(int32_t))));  // also of comparisons: 0 or -1

inline Floats all_lanes(float value) { return Floats{} + value; }
/// A row of numbers.
inline Floats lanes_of(const float (&values)[kBlock]) {
  Floats lanes;
  std::memcpy(&lanes, values, sizeof lanes);
  return lanes;
}
inline Floats min(const Floats& a, const Floats& b) { return a < b ? a : b; }
inline Floats max(const Floats& a, const Floats& b) { return a > b ? a : b; }

/// Numbers for each colour channel.
using FloatsRgb = std::array<Floats, 3>;
inline FloatsRgb all_lanes(const Rgb& rgb) { return {all_lanes(rgb.r), all_lanes(rgb.g), all_lanes(rgb.b)}; }
inline Floats mean_channel(const FloatsRgb& rgb) { return (rgb[0] + rgb[1] + rgb[2]) * (1.0f / 3.0f); }

/// Is the mask set in any lane?
inline bool any(const LaneMask& mask) {
#if defined(__AVX512F__)
  const auto lanes = std::bit_cast<__m512i>(mask);
  return _mm512_test_epi32_mask(lanes, lanes) != 0;
#else
  int32_t all = 0;
  for (const int32_t lane : std::bit_cast<std::array<int32_t, kBlock> >(mask)) all |= lane;
  return all != 0;
#endif
}

/// In how many lanes the mask is set.
inline uint32_t lanes_in(const LaneMask& mask) {
#if defined(__AVX512F__)
  const auto lanes = std::bit_cast<__m512i>(mask);
  return static_cast<uint32_t>(std::popcount(static_cast<uint16_t>(_mm512_test_epi32_mask(lanes, lanes))));
#else
  uint32_t number = 0;
  for (const int32_t lane : std::bit_cast<std::array<int32_t, kBlock> >(mask)) number += lane != 0 ? 1 : 0;
  return number;
#endif
}

inline Floats sqrt(const Floats& x) {
#if defined(__AVX512F__)
  return std::bit_cast<Floats>(_mm512_sqrt_ps(std::bit_cast<__m512>(x)));
#else
  auto values = std::bit_cast<std::array<float, kBlock> >(x);
  for (float& value : values) value = std::sqrt(value);
  return std::bit_cast<Floats>(values);
#endif
}

inline Floats abs(const Floats& x) { return max(x, Floats{} - x); }

/// Places or directions.
struct Floats3 {
  Floats x{}, y{}, z{};

  void set(size_t lane, const Vec3& v) {
    x[lane] = v.x;
    y[lane] = v.y;
    z[lane] = v.z;
  }
  Vec3 operator[](size_t lane) const { return {x[lane], y[lane], z[lane]}; }
  friend Floats3 operator-(const Vec3& a, const Floats3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Floats3 operator-(const Floats3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Floats3 operator-(const Floats3& a, const Floats3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Floats3 operator+(const Floats3& a, const Floats3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Floats3 operator*(const Floats& a, const Floats3& b) { return {a * b.x, a * b.y, a * b.z}; }
  friend Floats3 operator*(float a, const Floats3& b) { return {a * b.x, a * b.y, a * b.z}; }
};
inline Floats3 operator*(const Floats& a, const Vec3& b) { return {a * b.x, a * b.y, a * b.z}; }
inline Floats dot(const Floats3& a, const Floats3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Floats dot(const Vec3& a, const Floats3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Floats3 cross(const Vec3& a, const Floats3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace vpm
