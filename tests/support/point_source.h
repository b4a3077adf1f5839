// The exact fluence around an isotropic point source in an infinite medium that scatters isotropically, for tests.
#pragma once

#include <cmath>

namespace vpm {

/// Fluence of a 1 W source at distance r in a medium of sigma_t = 1/m and albedo c < 1, W/m^2: the discrete mode plus
/// the integral over the continuum [Case1953], (1/4 pi r) {D exp(-k0 r) + int_0^1 exp(-r/nu) nu^-2 / [(1 - c nu atanh
/// nu)^2 + (pi c nu/2)^2] dnu}.
inline double point_source_fluence(double c, double r) {
  double lo = 1e-9, hi = 1.0 - 1e-15;  // k0: c atanh(k0) = k0
  for (int i = 0; i < 200; ++i) {
    const double k = 0.5 * (lo + hi);
    (c * std::atanh(k) < k ? lo : hi) = k;
  }
  const double k0 = 0.5 * (lo + hi), d = 2.0 * k0 * k0 * (1.0 - k0 * k0) / (c * (c - 1.0 + k0 * k0));
  double sum = 0.0;
  constexpr int kSteps = 4000;
  for (int i = 0; i < kSteps; ++i) {
    // nu = 1 - (1 - x)^4 gathers nodes at 1, where the integrand varies like a logarithm.
    const double x = (i + 0.5) / kSteps, rest = (1.0 - x) * (1.0 - x) * (1.0 - x) * (1.0 - x), nu = 1.0 - rest;
    const double atanh_nu = 0.5 * (std::log1p(nu) - std::log(rest));
    const double a = 1.0 - c * nu * atanh_nu, b = 0.5 * M_PI * c * nu;
    sum += std::exp(-r / nu) / (nu * nu) / (a * a + b * b) * 4.0 * (1.0 - x) * (1.0 - x) * (1.0 - x) / kSteps;
  }
  return (d * std::exp(-k0 * r) + sum) / (4.0 * M_PI * r);
}

/// The same, averaged over the ball of radius h about a point at distance r with Epanechnikov's kernel: what a photon
/// map with that kernel has for its mean.
inline double smoothed_point_source_fluence(double c, double r, double h) {
  // Over a sphere of radius s about the point, a radial field has the mean int_{r-s}^{r+s} phi(u) u du / (2 r s).
  constexpr int kShells = 24, kAlong = 24;
  double sum = 0.0, norm = 0.0;
  for (int i = 0; i < kShells; ++i) {
    const double s = h * (i + 0.5) / kShells, weight = (1.0 - s * s / (h * h)) * s * s;
    double mean = 0.0;
    for (int j = 0; j < kAlong; ++j) {
      const double u = r - s + 2.0 * s * (j + 0.5) / kAlong;
      mean += point_source_fluence(c, u) * u / (r * kAlong);
    }
    sum += weight * mean;
    norm += weight;
  }
  return sum / norm;
}

}  // namespace vpm
