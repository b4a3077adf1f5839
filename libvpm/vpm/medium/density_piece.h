// The density along a short segment of a ray. It is a cubic polynomial, so its density integral is exactly a quartic.
#pragma once

#include <algorithm>
#include <cmath>

namespace vpm {

/// Density on [t0, t1] metres along a ray as the polynomial c0 + c1 s + c2 s^2 + c3 s^3 in s = t - t0. Inside one cell
/// a trilinear field is exactly that.
struct DensityPiece {
  double t0 = 0.0;  // m
  double t1 = 0.0;  // m
  double c0 = 0.0, c1 = 0.0, c2 = 0.0, c3 = 0.0;

  [[gnu::always_inline]] double length() const { return t1 - t0; }  // infinite only where uniform()
  [[gnu::always_inline]] bool uniform() const { return c1 == 0.0 && c2 == 0.0 && c3 == 0.0; }
  [[gnu::always_inline]] double density(double s) const { return c0 + s * (c1 + s * (c2 + s * c3)); }
  /// The density integral from t0 to t0 + s, m (times sigma_t: optical depth). Densities are not negative, so neither
  /// is the integral, except by rounding.
  [[gnu::always_inline]] double integral(double s) const {
    return uniform() ? s * c0 : s * (c0 + s * (c1 / 2 + s * (c2 / 3 + s * (c3 / 4))));
  }
  [[gnu::always_inline]] double integral() const { return integral(length()); }

  /// The s in [0, length()] at which integral(s) reaches `target`, 0 <= target <= integral(). Uses Newton's iteration
  /// inside a shrinking bracket, because the density may vanish at corners of a cell.
  [[gnu::always_inline]] double invert(double target) const {
    if (uniform()) return c0 > 0.0 ? std::min(target / c0, length()) : length();
    double lo = 0.0;
    double hi = length();
    double s = hi * std::clamp(target / integral(), 0.0, 1.0);
    for (int i = 0; i < kMaxIterations; ++i) {
      const double excess = integral(s) - target;
      (excess > 0.0 ? hi : lo) = s;
      const double slope = density(s);
      double next = slope > 0.0 ? s - excess / slope : -1.0;
      if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
      if (std::abs(next - s) <= 1e-12 * length()) return next;
      s = next;
    }
    return s;
  }

 private:
  /// Bisection alone would need 40 iterations to reach the tolerance. Each failed Newton step costs one iteration.
  static constexpr int kMaxIterations = 80;
};

}  // namespace vpm
