// Radii that shrink from pass to pass, so that bias and variance both vanish.
#pragma once

#include <cmath>

namespace vpm {

/// The measure (length, area or volume) of the kernel in pass number `pass` (from 0) over that in the first:
/// measure_{i+1} / measure_i = (i + A) / (i + 1), i = 1, 2, ... [Knaus2011, sec. 4]. The product of the factors up to
/// i = pass is Gamma(pass + 1 + A) / (Gamma(1 + A) Gamma(pass + 2)).
inline double measure_of_pass(double a, int pass) {
  return std::exp(std::lgamma(pass + 1.0 + a) - std::lgamma(1.0 + a) - std::lgamma(pass + 2.0));
}

/// A for a kernel of that dimension d, 4 / (d + 4): variance and squared bias of the mean of passes fall alike
/// [Knaus2011, sec. 4].
constexpr double best_a(int dimension) { return 4.0 / (dimension + 4.0); }

/// The radius of pass number `pass`, for a first radius and a kernel of that dimension.
inline float radius_of_pass(float first, int dimension, int pass) {
  return static_cast<float>(first * std::pow(measure_of_pass(best_a(dimension), pass), 1.0 / dimension));
}

}  // namespace vpm
