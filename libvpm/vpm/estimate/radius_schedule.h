// Radii that shrink from pass to pass, so that bias and variance both vanish.
#pragma once

#include <cmath>

namespace vpm {

/// The measure (length, area or volume) of the kernel in pass number `pass` (from 0) over that in the first:
/// measure_{i+1} / measure_i = (i + A) / (i + 1), i = 1, 2, ... [Knaus2011, sec. 4; Jarosz2011b].
inline double measure_of_pass(double a, int pass) {
  double measure = 1.0;
  for (int i = 1; i <= pass; ++i) measure *= (i + a) / (i + 1.0);
  return measure;
}

/// A for a kernel of that dimension d whose bias goes with the power `order` of the radius: variance and squared bias
/// of the mean of passes fall alike. 4 / (d + 4) for order 2 [Knaus2011, sec. 4], 8 / (d + 8) for order 4 in the same
/// way: with measures as n^(A-1), the variance of n passes falls as n^-A and the bias as n^((A-1) order/d).
constexpr double best_a(int dimension, int order = 2) { return 2.0 * order / (dimension + 2.0 * order); }

/// The radius of pass number `pass`, for a first radius and a kernel of that dimension and order.
inline float radius_of_pass(float first, int dimension, int pass, int order = 2) {
  return static_cast<float>(first * std::pow(measure_of_pass(best_a(dimension, order), pass), 1.0 / dimension));
}

}  // namespace vpm
