// The exponential of what is not positive, without branches and without a call: loops of it become vector instructions.
// Compilers must be told so, as they count how often it stands in a function, once for each phase function: a call took
// 13 % of a render of fog.
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
// The bits of n + kRound count up with n: this makes them the exponent of 2^n.
inline constexpr int32_t kToExponent = 127 - std::bit_cast<int32_t>(kRound);

/// `n` + kRound of a number above -88, and the polynomial; of a float or of Floats.
template <class Real>
[[gnu::always_inline]] inline Real rounded(const Real& x) {
  return x * kPerLog2 + kRound;
}
template <class Real>
[[gnu::always_inline]] inline Real polynomial(const Real& x, const Real& n) {
  const Real rest = (x - n * kUpper) - n * kLower;
  Real sum = 1.0f / 5040.0f;
  for (const float term : {1.0f / 720.0f, 1.0f / 120.0f, 1.0f / 24.0f, 1.0f / 6.0f, 0.5f, 1.0f, 1.0f})
    sum = sum * rest + term;
  return sum;
}

}  // namespace exponential

/// exp(x) for x <= 0, off by at most 1.5 units in the last place; 0 below -87, where it is less than 1.7e-38; NaN of
/// NaN.
[[gnu::always_inline]] inline float exp_negative(float x) {
  using namespace exponential;
  const float bounded = std::max(x, kLeast - 1.0f), n = rounded(bounded);
  const float power = std::bit_cast<float>((std::bit_cast<int32_t>(n) + kToExponent) << 23);
  return x < kLeast ? 0.0f : polynomial(bounded, n - kRound) * power;
}
/// The same of many numbers.
[[gnu::always_inline]] inline Floats exp_negative(const Floats& x) {
  using namespace exponential;
  const Floats bounded = max(kLeast - 1.0f, x), n = rounded(bounded);  // of a NaN max() is the second
  const Floats power = with_bits((as_bits(n) + kToExponent) << 23);
  return select(x < kLeast, 0.0f, polynomial(bounded, n - kRound) * power);
}

}  // namespace vpm
