// What passes through a medium along many rays at once.
#pragma once

#include "vpm/base/exp_negative.h"

namespace vpm {

/// Extinction where the density is 1, 1/m, and which channels have that of the channel before: most media are grey, and
/// an exponential is what lanes take longest for.
struct Extinction {
  Rgb sigma_t;
  bool repeats[3];

  explicit Extinction(const Rgb& of_channels)
      : sigma_t(of_channels), repeats{false, sigma_t.g == sigma_t.r, sigma_t.b == sigma_t.g} {}
  bool grey() const { return repeats[1] && repeats[2]; }
};

/// exp(-sigma_t integral), channel by channel, times `before`. The integrals are of density, m.
inline FloatsRgb attenuated(const FloatsRgb& before, const Extinction& extinction, const Floats& integral) {
  FloatsRgb passed;
  Floats left{};
  for (int c = 0; c < 3; ++c) {
    if (c == 0 || !extinction.repeats[c]) left = exp_negative(-extinction.sigma_t[c] * integral);
    passed[c] = before[c] * left;
  }
  return passed;
}

}  // namespace vpm
