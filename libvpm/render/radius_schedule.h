// Radii that shrink from pass to pass, so that bias and variance both vanish.
#pragma once

#include <cmath>

namespace vpm {

/// The radius of pass number `pass` (from 0), for a first radius and a kernel of dimension d: r_{i+1}^d = r_i^d (i + A)
/// / (i + 1), i = 1, 2, ..., with A = 4 / (d + 4), at which variance and squared bias of the mean of passes fall alike
/// [Knaus2011, sec. 4]. The product of the factors up to i = pass is Gamma(pass + 1 + A) / (Gamma(1 + A) Gamma(pass +
/// 2)).
inline float radius_of_pass(float first, int dimension, int pass) {
  const double a = 4.0 / (dimension + 4.0);
  const double log_measure = std::lgamma(pass + 1.0 + a) - std::lgamma(1.0 + a) - std::lgamma(pass + 2.0);
  return static_cast<float>(first * std::exp(log_measure / dimension));
}

}  // namespace vpm
