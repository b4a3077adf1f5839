#include "vpm/study/exact/point_source.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "vpm/base/vec.h"
#include "vpm/study/exact/quadrature.h"
#include "vpm/study/exact/special_functions.h"

namespace vpm::exact {

namespace {

constexpr double kRoundingOfIntegrals = 1e-13;

double uncollided_fluence(double r) { return std::exp(-r) / (4.0 * kPiD * r * r); }

/// The discrete mode of isotropic scattering [Case1953]: D exp(-k0 r) / (4 pi r), albedo atanh(k0) = k0.
struct DiscreteMode {
  double k0, d;
};
DiscreteMode discrete_mode(double albedo) {
  const double excess = (1.0 - albedo) / albedo;  // y coth(y) - 1 with k0 = tanh(y)
  double y = 1.0 + excess;  // too large, and the function is convex: Newton's method descends to the root
  for (double step = y; step > 1e-16 * y;) {
    const double s = std::sinh(y), slope = y > 1e-3 ? 1.0 / std::tanh(y) - y / (s * s) : 2.0 * y / 3.0;
    step = std::min(step, (coth_excess(y) - excess) / slope);
    if (!(step > 0.0)) break;
    y -= step;
  }
  if (excess == 0.0) return {0.0, 3.0};
  const double k = std::tanh(y), rest = 1.0 / (std::cosh(y) * std::cosh(y)), ratio = 1.0 + excess;
  return {k, 2.0 * k * k * rest * ratio * ratio / (k * k * ratio - excess)};
}

/// What the continuum has beyond the uncollided light, at a = 1/nu = 1 + exp(x):
/// 1 / ((1 - albedo atanh(1/a) / a)^2 + (pi albedo / 2a)^2) - 1.
double continuum_excess(double albedo, double x) {
  const double a = 1.0 + std::exp(x);
  const double even = albedo / a * 0.5 * std::log1p(2.0 * std::exp(-x)), odd = 0.5 * kPiD * albedo / a;
  const double below = even * (2.0 - even) - odd * odd;  // 1 - denominator
  return below / (1.0 - below);
}

/// phi as a sum of exp(-r/nu) / (4 pi nu^2 r), and a term in 1/r where nothing is absorbed.
struct SpectralSum {
  std::vector<double> nu, weight;
  double long_range = 0.0;  // times 1 / (4 pi r)
};

/// P_N by its continued fraction [Case1967]: the fluence's Fourier transform is 1/(h0 + k^2/(h1 + 4k^2/(h2 + 9k^2/(h3 +
/// ...)))) with h_l = (2l+1)(1 - albedo chi_l), a sum over the Gauss rule of the Jacobi matrix with l/sqrt(h_{l-1}
/// h_l).
SpectralSum spectral_sum(double albedo, const PhaseMoments& phase, int orders) {
  const auto h = [&](size_t l) { return (2.0 * l + 1.0) * (1.0 - albedo * (l < phase.size() ? phase[l] : 0.0)); };
  const bool conserving = h(0) == 0.0;  // then it is h1/k^2 + 4/(h2 + 9k^2/(h3 + ...))
  const size_t first = conserving ? 2 : 0;
  std::vector<double> off;
  for (size_t l = first + 1; l < first + orders; ++l) off.push_back(l / std::sqrt(h(l - 1) * h(l)));
  const GaussRule rule = jacobi_rule(std::vector<double>(orders, 0.0), off);
  SpectralSum sum;
  sum.long_range = conserving ? h(1) : 0.0;
  for (int i = orders / 2; i < orders; ++i) {  // nodes come in pairs of opposite signs
    sum.nu.push_back(rule.nodes[i]);
    sum.weight.push_back(2.0 * rule.weights[i] * (conserving ? 4.0 : 1.0) / h(first));
  }
  return sum;
}

double fluence(const SpectralSum& sum, double r) {
  double total = sum.long_range;
  for (size_t i = 0; i < sum.nu.size(); ++i)
    total += sum.weight[i] * std::exp(-r / sum.nu[i]) / (sum.nu[i] * sum.nu[i]);
  return total / (4.0 * kPiD * r);
}
double collisions(const SpectralSum& sum, double r) {
  double total = 0.5 * sum.long_range * r * r;
  for (size_t i = 0; i < sum.nu.size(); ++i)
    total += sum.weight[i] * exponential_moment(1.0 / sum.nu[i], r) / (sum.nu[i] * sum.nu[i]);
  return total;
}

}  // namespace

PointSourceSolution point_source_case(double albedo, const std::vector<double>& radii) {
  assert(albedo >= 0.0 && albedo <= 1.0);
  PointSourceSolution solution;
  for (const double r : radii) {
    assert(r > 0.0);
    Bounded phi, count{-std::expm1(-r), 0.0};
    if (albedo > 0.0) {
      const DiscreteMode mode = discrete_mode(albedo);
      const auto decay = [&](double x) { return std::exp(x - r * (1.0 + std::exp(x))) * continuum_excess(albedo, x); };
      const auto moment = [&](double x) {
        return std::exp(x) * exponential_moment(1.0 + std::exp(x), r) * continuum_excess(albedo, x);
      };
      const Bounded tail = integrate(decay, -45.0, std::max(0.0, std::log(745.0 / r)));
      const double near = mode.d * std::exp(-mode.k0 * r), norm = 4.0 * kPiD * r;
      phi = {(near + tail.value) / norm, (tail.error + kRoundingOfIntegrals * near) / norm};
      const Bounded inner = integrate(moment, -45.0, 45.0);
      const double outer = mode.d * exponential_moment(mode.k0, r);
      count = {count.value + outer + inner.value, inner.error + kRoundingOfIntegrals * outer};
    }
    solution.uncollided.push_back(uncollided_fluence(r));
    solution.collided.push_back(phi);
    solution.collisions.push_back({count.value, count.error + kRoundingOfIntegrals * count.value});
  }
  return solution;
}

PointSourceSolution point_source_pn(double albedo, const PhaseMoments& phase, const std::vector<double>& radii) {
  assert(albedo >= 0.0 && albedo <= 1.0 && !phase.empty());
  constexpr int kFine = 1602, kCoarse = 1202;
  // Light that has not collided is slow to converge near the source: P_N's own is taken off.
  const SpectralSum fine = spectral_sum(albedo, phase, kFine), coarse = spectral_sum(albedo, phase, kCoarse);
  const SpectralSum free_fine = spectral_sum(0.0, phase, kFine), free_coarse = spectral_sum(0.0, phase, kCoarse);
  PointSourceSolution solution;
  for (const double r : radii) {
    assert(r > 0.0);
    const double phi = fluence(fine, r) - fluence(free_fine, r);
    const double coarse_phi = fluence(coarse, r) - fluence(free_coarse, r);
    const double count = collisions(fine, r) - collisions(free_fine, r) - std::expm1(-r);
    const double coarse_count = collisions(coarse, r) - collisions(free_coarse, r) - std::expm1(-r);
    solution.uncollided.push_back(uncollided_fluence(r));
    solution.collided.push_back(
        {phi, std::fabs(phi - coarse_phi) + kRoundingOfIntegrals * (phi + uncollided_fluence(r))});
    solution.collisions.push_back({count, std::fabs(count - coarse_count) + kRoundingOfIntegrals * count});
  }
  return solution;
}

PointSourceSolution solve_point_source(double albedo, const PhaseMoments& phase, const std::vector<double>& radii) {
  return phase.size() == 1 ? point_source_case(albedo, radii) : point_source_pn(albedo, phase, radii);
}

}  // namespace vpm::exact
