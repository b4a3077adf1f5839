// Normal numbers for tests of statistics.
#pragma once

#include <cmath>

#include "vpm/base/rng.h"
#include "vpm/base/vec.h"

namespace vpm {

/// A number of the standard normal distribution.
inline double normal(Rng& rng) {
  const double u = 1.0 - rng.uniform_double(), v = rng.uniform_double();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * kPiD * v);
}

}  // namespace vpm
