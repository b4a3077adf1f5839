// The exponential of what is not positive, without branches and without a call: loops of it become vector instructions.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace vpm {

/// exp(x) for x <= 0, off by at most 1.5 units in the last place; 0 below -87, where it is less than 1.7e-38.
inline float exp_negative(float x) {
  const float bounded = std::max(x, -88.0f);
  // x = n log 2 + rest, with a log 2 in two parts, of which n times the first is exact; |rest| <= log(2)/2 up to
  // rounding. There the Taylor polynomial is off by 5e-9.
  constexpr float kUpper = 0.693359375f, kLower = -2.12194440e-4f, kPerLog2 = 1.44269504f;
  constexpr float kRound = 0x1.8p23f;  // a float that is added to this has no room for a fraction
  const float n = (bounded * kPerLog2 + kRound) - kRound;
  const float rest = (bounded - n * kUpper) - n * kLower;
  float sum = 1.0f / 5040.0f;
  for (const float term : {1.0f / 720.0f, 1.0f / 120.0f, 1.0f / 24.0f, 1.0f / 6.0f, 0.5f, 1.0f, 1.0f})
    sum = sum * rest + term;
  const float result = sum * std::bit_cast<float>((static_cast<int32_t>(n) + 127) << 23);
  return x < -87.0f ? 0.0f : result;
}

}  // namespace vpm
