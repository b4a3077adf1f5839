// Picking out those of many numbers that lie below a limit, without a branch for each.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace vpm {

/// Numbers looked at at once.
inline constexpr uint32_t kBlock = 16;

/// Appends those of the first `count` <= kBlock values that are below the limit to `found`, and to `numbers` which ones
/// they are, from `first` on. Reads and writes kBlock places of each. Returns how many there are.
inline uint32_t append_below(const float* values, uint32_t count, float limit, uint32_t first, float* found,
                             uint32_t* numbers) {
  assert(count <= kBlock);
#if defined(__AVX512F__)
  const __m512 all = _mm512_loadu_ps(values);
  const __m512i which = _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(first)),
                                         _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
  const auto below =
      static_cast<__mmask16>(_mm512_cmp_ps_mask(all, _mm512_set1_ps(limit), _CMP_LT_OQ) & ((1u << count) - 1));
  _mm512_storeu_ps(found, _mm512_maskz_compress_ps(below, all));
  _mm512_storeu_si512(numbers, _mm512_maskz_compress_epi32(below, which));
  return static_cast<uint32_t>(__builtin_popcount(below));
#else
  uint32_t kept = 0;
  for (uint32_t i = 0; i < count; ++i) {
    found[kept] = values[i];
    numbers[kept] = first + i;
    kept += values[i] < limit ? 1 : 0;
  }
  return kept;
#endif
}

/// Moves those of `count` values that are at most the limit, with their numbers, to the front, in their order. Reads
/// and writes up to the next multiple of kBlock. Returns how many there are.
inline size_t keep_up_to(float* values, uint32_t* numbers, size_t count, float limit) {
  size_t kept = 0;
#if defined(__AVX512F__)
  for (size_t i = 0; i < count; i += kBlock) {
    const __m512 some = _mm512_loadu_ps(values + i);
    const __m512i which = _mm512_loadu_si512(numbers + i);
    const uint32_t there = count - i < kBlock ? (1u << (count - i)) - 1 : 0xffffu;
    const auto keep = static_cast<__mmask16>(_mm512_cmp_ps_mask(some, _mm512_set1_ps(limit), _CMP_LE_OQ) & there);
    _mm512_storeu_ps(values + kept, _mm512_maskz_compress_ps(keep, some));
    _mm512_storeu_si512(numbers + kept, _mm512_maskz_compress_epi32(keep, which));
    kept += static_cast<size_t>(__builtin_popcount(keep));
  }
#else
  for (size_t i = 0; i < count; ++i) {
    const float value = values[i];
    values[kept] = value;
    numbers[kept] = numbers[i];
    kept += value <= limit ? 1 : 0;
  }
#endif
  return kept;
}

/// How many of the values are at most the limit.
inline size_t count_up_to(const float* values, size_t count, float limit) {
  uint32_t all = 0;
  for (size_t i = 0; i < count; ++i) all += values[i] <= limit ? 1 : 0;
  return all;
}

/// The largest of the values, which are >= 0, that are at most the limit; 0 of none.
inline float largest_up_to(const float* values, size_t count, float limit) {
  int32_t largest = 0;  // the bits of such numbers are in the same order, and integers are compared many at once
  for (size_t i = 0; i < count; ++i)
    largest = std::max(largest, std::bit_cast<int32_t>(values[i] <= limit ? values[i] : 0.0f));
  return std::bit_cast<float>(largest);
}

/// The k-th smallest of `count` values, 1 <= k <= count, which are finite and >= 0: the interval that holds it is
/// halved until nothing else is in it. Each step is one look at all values, many at once. Of evenly spread values, such
/// as squared distances of neighbours, there are about as many steps as binary digits of `count`; of values of very
/// different magnitudes up to some 150.
inline float kth_smallest(const float* values, size_t count, size_t k) {
  assert(k >= 1 && k <= count);
  float lo = -1.0f, hi = largest_up_to(values, count, std::numeric_limits<float>::max());
  for (size_t up_to_hi = count; up_to_hi != k;) {  // fewer than k are up to lo
    const float middle = 0.5f * (std::max(lo, 0.0f) + hi);
    if (!(middle > lo && middle < hi)) break;  // equal ones
    const size_t up_to = count_up_to(values, count, middle);
    (up_to < k ? lo : hi) = middle;
    if (up_to >= k) up_to_hi = up_to;
  }
  return largest_up_to(values, count, hi);
}

}  // namespace vpm
