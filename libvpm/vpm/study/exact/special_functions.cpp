#include "vpm/study/exact/special_functions.h"

#include <boost/math/special_functions/expint.hpp>
#include <cassert>
#include <cmath>

namespace vpm::exact {

double exponential_integral(int n, double x) {
  assert(n >= 1 && x >= 0.0 && (x > 0.0 || n > 1));
  return boost::math::expint(static_cast<unsigned>(n), x);
}

double coth_excess(double x) {
  if (x > 0.1) return x / std::tanh(x) - 1.0;
  const double s = x * x;  // the Taylor series
  return s / 3.0 * (1.0 - s / 15.0 * (1.0 - 2.0 * s / 21.0 * (1.0 - s / 10.0 * (1.0 - 10.0 * s / 99.0))));
}

double exponential_moment(double a, double r) {
  const double x = a * r;
  if (x > 0.5) return (-std::expm1(-x) - x * std::exp(-x)) / (a * a);
  // sum over n of (-x)^n / (n! (n + 2)), times r^2
  double sum = 0.0, power = 1.0;
  for (int n = 0; n < 16; ++n) {
    sum += power / (n + 2);
    power *= -x / (n + 1);
  }
  return r * r * sum;
}

}  // namespace vpm::exact
