// The exponential of what is not positive, without branches and without a call: loops of it become vector instructions.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "vpm/base/floats.h"

namespace vpm {

namespace exponential {

// x = n log 2 + rest, with a log 2 in two parts, of which n times the first is exact; |rest| <= log(2)/2 up to
// rounding. There the Taylor polynomial is off by 5e-9.
inline constexpr float kUpper = 0.693359375f, kLower = -2.12194440e-4f, kPerLog2 = 1.44269504f;
inline constexpr float kRound = 0x1.8p23f;  // a float that is added to this has no room for a fraction
inline constexpr float kLeast = -87.0f;     // below, the exponential is less than 1.7e-38

/// `n` of a number above -88, and the polynomial; of a float or of Floats.
template <class Real>
Real whole_part(const Real& x) {
  return (x * kPerLog2 + kRound) - kRound;
}
template <class Real>
Real polynomial(const Real& x, const Real& n) {
  const Real rest = (x - n * kUpper) - n * kLower;
  Real sum = 1.0f / 5040.0f;
  for (const float term : {1.0f / 720.0f, 1.0f / 120.0f, 1.0f / 24.0f, 1.0f / 6.0f, 0.5f, 1.0f, 1.0f})
    sum = sum * rest + term;
  return sum;
}

}  // namespace exponential

/// exp(x) for x <= 0, off by at most 1.5 units in the last place; 0 below -87, where it is less than 1.7e-38.
inline float exp_negative(float x) {
  const float bounded = std::max(x, exponential::kLeast - 1.0f), n = exponential::whole_part(bounded);
  const float result =
      exponential::polynomial(bounded, n) * std::bit_cast<float>((static_cast<int32_t>(n) + 127) << 23);
  return x < exponential::kLeast ? 0.0f : result;
}
/// The same of many numbers.
inline Floats exp_negative(const Floats& x) {
  const Floats bounded = max(x, exponential::kLeast - 1.0f), n = exponential::whole_part(bounded);
  const Floats result = exponential::polynomial(bounded, n) * with_bits((truncated(n) + 127) << 23);
  return select(x < exponential::kLeast, 0.0f, result);
}

}  // namespace vpm
