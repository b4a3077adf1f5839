#include "vpm/study/exact/special_functions.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace vpm::exact {

double exponential_integral(int n, double x) {
  assert(n >= 1 && x >= 0.0 && (x > 0.0 || n > 1));
  if (x == 0.0) return 1.0 / (n - 1);
  if (x <= 1.0) {  // upwards from E_1 [Olver2010, eq. 8.19.12]
    double value = -std::expint(-x);
    for (int m = 1; m < n; ++m) value = (std::exp(-x) - x * value) / m;
    return value;
  }
  // The even part of the continued fraction [Olver2010, eq. 8.19.17], evaluated forwards by Lentz's method.
  double b = x + n, c = std::numeric_limits<double>::infinity(), d = 1.0 / b, value = d, change = 0.0;
  for (double i = 1.0; std::fabs(change - 1.0) > 1e-15; i += 1.0) {
    const double a = -i * (n - 1 + i);
    b += 2.0;
    c = b + a / c;
    d = 1.0 / (b + a * d);
    value *= change = c * d;
  }
  return std::exp(-x) * value;
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
