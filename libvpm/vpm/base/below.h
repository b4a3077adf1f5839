// Picking out those of many numbers that lie below a limit, without a branch for each.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "vpm/base/floats.h"

namespace vpm {

/// Appends those of the first `count` <= kBlock values that are below the limit to `found`, and to `numbers` which ones
/// they are, from `first` on. Reads and writes kBlock places of each. Returns how many there are.
inline uint32_t append_below(const float* values, uint32_t count, float limit, uint32_t first, float* found,
                             uint32_t* numbers) {
  assert(count <= kBlock);
  const Floats all = lanes_of(values);
  const uint32_t below = bits_of(all < limit) & ((1u << count) - 1);
  store_packed(all, below, found);
  return store_numbers(first, below, numbers);
}

/// Moves those of `count` values that are at most the limit, with their numbers, to the front, in their order. Reads
/// and writes up to the next multiple of kBlock. Returns how many there are.
inline size_t keep_up_to(float* values, uint32_t* numbers, size_t count, float limit) {
  size_t kept = 0;
  for (size_t i = 0; i < count; i += kBlock) {
    const Floats some = lanes_of(values + i);
    const Lanes<uint32_t> which = lanes_of(numbers + i);
    const uint32_t there = count - i < kBlock ? (1u << (count - i)) - 1 : 0xffffu;
    const uint32_t keep = bits_of(some <= limit) & there;
    store_packed(some, keep, values + kept);
    kept += store_packed(which, keep, numbers + kept);
  }
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
