// Numbers side by side that each operator takes all at once, in registers of the machine's own width. Wider vectors are
// compared lane by lane by g++, in more than a hundred instructions: findings/gcc-compares-wide-vectors-one-by-one.sh.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <utility>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "vpm/base/vec.h"

namespace vpm {

/// Numbers side by side. The same on every machine, so that everywhere the same numbers are added in the same order.
inline constexpr uint32_t kBlock = 16;

/// Of a register, as the program is compiled.
#if defined(__AVX512F__)
inline constexpr size_t kRegisterBytes = 64;
#elif defined(__AVX2__)
inline constexpr size_t kRegisterBytes = 32;
#else
inline constexpr size_t kRegisterBytes = 16;
#endif

/// kBlock numbers of four bytes each. A number stands for all lanes alike.
template <class T>
struct Lanes {
  static_assert(sizeof(T) == 4);
  using Register [[gnu::vector_size(kRegisterBytes)]] = T;
  static constexpr size_t kWidth = kRegisterBytes / sizeof(T), kRegisters = kBlock / kWidth;
  static constexpr auto kNumbers = std::make_index_sequence<kRegisters>();

  Register registers[kRegisters];

  Lanes() : registers{} {}
  template <std::same_as<T> Number>  // a bool, say, is no mask
  Lanes(Number value) : Lanes(kNumbers, [&](size_t) { return value - Register{}; }) {}
  /// op(number of a register) for each.
  template <size_t... k, class Op>
  Lanes(std::index_sequence<k...>, Op&& op) : registers{op(std::integral_constant<size_t, k>())...} {}

  T operator[](size_t lane) const { return registers[lane / kWidth][lane % kWidth]; }
  void set(size_t lane, T value) { registers[lane / kWidth][lane % kWidth] = value; }

  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return {kNumbers, [&](auto k) { return a.registers[k] + b.registers[k]; }};
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return {kNumbers, [&](auto k) { return a.registers[k] - b.registers[k]; }};
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return {kNumbers, [&](auto k) { return a.registers[k] * b.registers[k]; }};
  }
  friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return {kNumbers, [&](auto k) { return a.registers[k] / b.registers[k]; }};
  }
  friend Lanes operator&(const Lanes& a, const Lanes& b) {
    return {kNumbers, [&](auto k) { return a.registers[k] & b.registers[k]; }};
  }
  friend Lanes operator<<(const Lanes& a, int bits) {
    return {kNumbers, [&](auto k) { return a.registers[k] << bits; }};
  }
  Lanes& operator+=(const Lanes& other) { return *this = *this + other; }
  Lanes& operator-=(const Lanes& other) { return *this = *this - other; }
  Lanes& operator*=(const Lanes& other) { return *this = *this * other; }
  Lanes& operator/=(const Lanes& other) { return *this = *this / other; }
  Lanes& operator&=(const Lanes& other) { return *this = *this & other; }

  /// -1 in the lanes where it is so, else 0.
  friend Lanes<int32_t> operator<(const Lanes& a, const Lanes& b) {
    return {kNumbers, [&](auto k) { return a.registers[k] < b.registers[k]; }};
  }
  friend Lanes<int32_t> operator<=(const Lanes& a, const Lanes& b) {
    return {kNumbers, [&](auto k) { return a.registers[k] <= b.registers[k]; }};
  }
  friend Lanes<int32_t> operator==(const Lanes& a, const Lanes& b) {
    return {kNumbers, [&](auto k) { return a.registers[k] == b.registers[k]; }};
  }
  friend Lanes<int32_t> operator>(const Lanes& a, const Lanes& b) { return b < a; }
  friend Lanes<int32_t> operator>=(const Lanes& a, const Lanes& b) { return b <= a; }
};
using Floats = Lanes<float>;
using LaneMask = Lanes<int32_t>;  // of comparisons: -1 or 0

/// What the compiler's operators lack, of one register.
namespace one_register {

using F = Floats::Register;
using I = LaneMask::Register;

#if defined(__AVX512F__)
inline F min(F a, F b) { return F(_mm512_min_ps(__m512(a), __m512(b))); }
inline F max(F a, F b) { return F(_mm512_max_ps(__m512(a), __m512(b))); }
inline F sqrt(F x) { return F(_mm512_sqrt_ps(__m512(x))); }
inline uint32_t bits_of(I mask) { return _mm512_test_epi32_mask(__m512i(mask), __m512i(mask)); }
#elif defined(__AVX2__)
inline F min(F a, F b) { return F(_mm256_min_ps(__m256(a), __m256(b))); }
inline F max(F a, F b) { return F(_mm256_max_ps(__m256(a), __m256(b))); }
inline F sqrt(F x) { return F(_mm256_sqrt_ps(__m256(x))); }
inline uint32_t bits_of(I mask) { return static_cast<uint32_t>(_mm256_movemask_ps(__m256(mask))); }
#elif defined(__SSE2__)
inline F min(F a, F b) { return F(_mm_min_ps(__m128(a), __m128(b))); }
inline F max(F a, F b) { return F(_mm_max_ps(__m128(a), __m128(b))); }
inline F sqrt(F x) { return F(_mm_sqrt_ps(__m128(x))); }
inline uint32_t bits_of(I mask) { return static_cast<uint32_t>(_mm_movemask_ps(__m128(mask))); }
#else
inline F min(F a, F b) { return a < b ? a : b; }
inline F max(F a, F b) { return a > b ? a : b; }
inline F sqrt(F x) {
  for (size_t lane = 0; lane < Floats::kWidth; ++lane) x[lane] = std::sqrt(x[lane]);
  return x;
}
inline uint32_t bits_of(I mask) {
  uint32_t bits = 0;
  for (size_t lane = 0; lane < LaneMask::kWidth; ++lane) bits |= (mask[lane] != 0 ? 1u : 0u) << lane;
  return bits;
}
#endif

}  // namespace one_register

/// A row of kBlock numbers.
template <class T>
Lanes<T> lanes_of(const T* values) {
  return {Lanes<T>::kNumbers, [&](auto k) {
            typename Lanes<T>::Register some;
            std::memcpy(&some, values + k * Lanes<T>::kWidth, sizeof some);
            return some;
          }};
}

/// Lane by lane `a` where the mask is set, else `b`.
inline Floats select(const LaneMask& mask, const Floats& a, const Floats& b) {
  return {Floats::kNumbers, [&](auto k) { return mask.registers[k] ? a.registers[k] : b.registers[k]; }};
}
/// `a` where a < b, else `b`, also of NaNs and zeros.
inline Floats min(const Floats& a, const Floats& b) {
  return {Floats::kNumbers, [&](auto k) { return one_register::min(a.registers[k], b.registers[k]); }};
}
/// `a` where a > b, else `b`, likewise.
inline Floats max(const Floats& a, const Floats& b) {
  return {Floats::kNumbers, [&](auto k) { return one_register::max(a.registers[k], b.registers[k]); }};
}
inline Floats abs(const Floats& x) { return max(x, Floats{} - x); }
inline Floats sqrt(const Floats& x) {
  return {Floats::kNumbers, [&](auto k) { return one_register::sqrt(x.registers[k]); }};
}

/// The bits of floats, as integers.
inline LaneMask as_bits(const Floats& x) {
  return {LaneMask::kNumbers, [&](auto k) { return LaneMask::Register(x.registers[k]); }};
}
/// The floats of these bits.
inline Floats with_bits(const LaneMask& bits) {
  return {Floats::kNumbers, [&](auto k) { return Floats::Register(bits.registers[k]); }};
}

/// A bit for each lane in which the mask is set.
inline uint32_t bits_of(const LaneMask& mask) {
  uint32_t bits = 0;
  for (size_t k = 0; k < LaneMask::kRegisters; ++k)
    bits |= one_register::bits_of(mask.registers[k]) << (k * LaneMask::kWidth);
  return bits;
}
/// Is the mask set in any lane?
inline bool any(const LaneMask& mask) { return bits_of(mask) != 0; }
/// In how many lanes the mask is set.
inline uint32_t lanes_in(const LaneMask& mask) { return static_cast<uint32_t>(std::popcount(bits_of(mask))); }

#if defined(__AVX2__) && !defined(__AVX512F__)
/// Of eight bits the numbers of those that are set, one after another, a byte each.
inline constexpr std::array<uint64_t, 256> kNumbersOfBits = [] {
  std::array<uint64_t, 256> all{};
  for (uint64_t bits = 0; bits < 256; ++bits)
    for (uint64_t bit = 8; bit-- > 0;)
      if ((bits >> bit & 1) != 0) all[bits] = all[bits] << 8 | bit;
  return all;
}();
#endif

/// Writes those lanes, one after another, of which a bit is set, and returns how many there are. What stands in the
/// kBlock places from `to` on behind these is lost.
template <class T>
uint32_t store_packed(const Lanes<T>& lanes, uint32_t bits, T* to) {
#if defined(__AVX512F__)
  const auto packed = _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), __m512i(lanes.registers[0]));
  _mm512_storeu_si512(to, packed);
#elif defined(__AVX2__)
  uint32_t stored = 0;
  for (size_t k = 0; k < Lanes<T>::kRegisters; ++k) {
    const uint32_t some = bits >> (k * Lanes<T>::kWidth) & 0xff;
    const __m256i order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(kNumbersOfBits[some])));
    const __m256i packed = _mm256_permutevar8x32_epi32(__m256i(lanes.registers[k]), order);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + stored), packed);
    stored += static_cast<uint32_t>(std::popcount(some));
  }
#else
  const auto numbers = std::bit_cast<std::array<T, kBlock> >(lanes);
  uint32_t stored = 0;
  for (size_t lane = 0; lane < kBlock; ++lane) {
    to[stored] = numbers[lane];
    stored += bits >> lane & 1;
  }
#endif
  return static_cast<uint32_t>(std::popcount(bits));
}

/// The same of the lanes' numbers, counted from `first` on.
inline uint32_t store_numbers(uint32_t first, uint32_t bits, uint32_t* to) {
  constexpr uint32_t kFromZero[kBlock] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  return store_packed(lanes_of(kFromZero) + first, bits, to);
}

/// Numbers for each colour channel.
using FloatsRgb = std::array<Floats, 3>;
inline FloatsRgb all_lanes(const Rgb& rgb) { return {Floats(rgb.r), Floats(rgb.g), Floats(rgb.b)}; }
inline Floats mean_channel(const FloatsRgb& rgb) { return (rgb[0] + rgb[1] + rgb[2]) * (1.0f / 3.0f); }

/// Places or directions.
struct Floats3 {
  Floats x{}, y{}, z{};

  void set(size_t lane, const Vec3& v) {
    x.set(lane, v.x);
    y.set(lane, v.y);
    z.set(lane, v.z);
  }
  Vec3 operator[](size_t lane) const { return {x[lane], y[lane], z[lane]}; }
  /// From a row for each axis.
  static Floats3 of(const float* along_x, const float* along_y, const float* along_z) {
    return {lanes_of(along_x), lanes_of(along_y), lanes_of(along_z)};
  }
  friend Floats3 operator-(const Vec3& a, const Floats3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Floats3 operator-(const Floats3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Floats3 operator-(const Floats3& a, const Floats3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Floats3 operator+(const Vec3& a, const Floats3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Floats3 operator+(const Floats3& a, const Vec3& b) { return b + a; }
  friend Floats3 operator+(const Floats3& a, const Floats3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Floats3 operator*(const Floats& a, const Floats3& b) { return {a * b.x, a * b.y, a * b.z}; }
};
inline Floats3 operator*(const Floats& a, const Vec3& b) { return {a * b.x, a * b.y, a * b.z}; }
inline Floats dot(const Floats3& a, const Floats3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Floats dot(const Vec3& a, const Floats3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Floats dot(const Floats3& a, const Vec3& b) { return dot(b, a); }
inline Floats3 cross(const Vec3& a, const Floats3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace vpm
