// Numbers of twice the precision of a double.
#pragma once

#include <cmath>

namespace vpm {

/// A number as the unevaluated sum of two doubles, about 106 bits [Dekker1971]: |low| is at most half a unit in the
/// last place of high.
struct TwoDoubles {
  double high = 0.0, low = 0.0;

  double value() const { return high + low; }
};

/// a + b without rounding error, whichever is larger [Knuth1997, sec. 4.2.2, theorem B].
inline TwoDoubles exact_sum(double a, double b) {
  const double sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}
/// To a relative 2^-104 [Joldes2017, algorithm 6].
inline TwoDoubles operator+(const TwoDoubles& a, const TwoDoubles& b) {
  const TwoDoubles high = exact_sum(a.high, b.high), low = exact_sum(a.low, b.low);
  const TwoDoubles sum = exact_sum(high.high, high.low + low.high);
  return exact_sum(sum.high, sum.low + low.low);
}
inline TwoDoubles operator-(const TwoDoubles& a, const TwoDoubles& b) { return a + TwoDoubles{-b.high, -b.low}; }
/// To a relative 2^-102 or so; without error where both are single doubles.
inline TwoDoubles operator*(const TwoDoubles& a, const TwoDoubles& b) {
  const double product = a.high * b.high, rest = std::fma(a.high, b.high, -product);
  return exact_sum(product, rest + (a.high * b.low + a.low * b.high));
}

}  // namespace vpm
