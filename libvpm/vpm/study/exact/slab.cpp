#include "vpm/study/exact/slab.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "vpm/base/vec.h"
#include "vpm/study/exact/ordinates.h"
#include "vpm/study/exact/phase_moments.h"
#include "vpm/study/exact/quadrature.h"
#include "vpm/study/exact/special_functions.h"

namespace vpm::exact {

namespace {

constexpr int kMostOrdinates = 256;  // that we pay for

/// Ordinates of a hemisphere that resolve a phase function.
int ordinate_count(const PhaseMoments& phase) {
  size_t orders = phase.size();
  while (orders > 1 && std::fabs(phase[orders - 1]) < 1e-14) --orders;
  return std::clamp(2 * static_cast<int>(orders) / 3, 64, kMostOrdinates);
}

/// Uncollided light at optical depth t: its fluence and downward flux, in truth and by the ordinates.
struct Uncollided {
  double fluence, flux;
};
Uncollided uncollided(Incidence incidence, double t) {
  if (std::isinf(t)) return {0.0, 0.0};
  if (incidence == Incidence::collimated_normal) return {std::exp(-t), std::exp(-t)};
  return {2.0 * exponential_integral(2, t), 2.0 * exponential_integral(3, t)};
}
Uncollided uncollided(const Ordinates& ordinates, const std::vector<double>& incoming, double t) {
  Uncollided sum{0.0, 0.0};
  if (std::isinf(t)) return sum;
  for (size_t i = 0; i < incoming.size(); ++i) {
    const double term = 2.0 * kPiD * ordinates.weight[i] * incoming[i] * std::exp(-t / ordinates.mu[i]);
    sum.fluence += term;
    sum.flux += ordinates.mu[i] * term;
  }
  return sum;
}

std::vector<double> incoming_radiance(Incidence incidence, const Ordinates& ordinates) {
  if (incidence == Incidence::diffuse) return std::vector<double>(ordinates.mu.size(), 1.0 / kPiD);
  std::vector<double> beam(ordinates.mu.size(), 0.0);
  beam.back() = 1.0 / (2.0 * kPiD * ordinates.weight.back());
  return beam;
}

/// 2 pi int mu L dmu over each bin, with mu = s^2 as at the ordinates.
template <class Radiance>
std::vector<double> bin_flux(const std::vector<double>& edges, const Radiance& radiance) {
  static const GaussRule rule = gauss_legendre(24);
  std::vector<double> flux;
  for (size_t bin = 0; bin + 1 < edges.size(); ++bin) {
    const double s0 = std::sqrt(edges[bin]), width = std::sqrt(edges[bin + 1]) - s0;
    double sum = 0.0;
    for (size_t i = 0; i < rule.nodes.size(); ++i) {
      const double s = s0 + width * rule.nodes[i];
      sum += rule.weights[i] * width * 2.0 * s * s * s * radiance(s * s);
    }
    flux.push_back(2.0 * kPiD * sum);
  }
  return flux;
}

/// The whole solution by `count` ordinates, without errors.
SlabSolution solve_with(int count, const Slab& slab, const SlabPlaces& places) {
  // Our ordinates integrate products of two Legendre polynomials of order 3/2 count well, not of higher.
  const TruncatedSlab scaled = truncate_forward_peak(slab.albedo, slab.phase, 3 * count / 2);
  const Ordinates ordinates = make_ordinates(count);
  const Modes modes = make_modes(scaled.albedo, scaled.phase, ordinates);
  const std::vector<double> incoming = incoming_radiance(slab.incidence, ordinates);
  const LayerField field = illuminate(modes, scaled.depth_scale * slab.tau, incoming);

  // The ordinates' error in the uncollided light is known, and taken off.
  const auto correction = [&](double t) {
    const Uncollided truth = uncollided(slab.incidence, t), ours = uncollided(ordinates, incoming, t);
    return Uncollided{truth.fluence - ours.fluence, truth.flux - ours.flux};
  };
  SlabSolution solution;
  const auto flux_at = [&](double t) { return net_flux(field, t) + correction(t).flux; };
  solution.reflected.value = 1.0 - flux_at(0.0);
  solution.transmitted.value = std::isinf(slab.tau) ? 0.0 : flux_at(field.tau);
  solution.absorbed.value = 1.0 - solution.reflected.value - solution.transmitted.value;
  solution.unscattered = uncollided(slab.incidence, slab.tau).flux;
  for (const double depth : places.depths) {
    const double t = scaled.depth_scale * depth;
    solution.fluence.values.push_back(fluence(field, t) + correction(t).fluence);
    solution.net_flux.values.push_back(flux_at(t));
    solution.uncollided_fluence.push_back(uncollided(slab.incidence, depth).fluence);
  }
  const auto missing = [&](double cosine) {
    return slab.incidence == Incidence::diffuse ? 0.0 : missing_single_scattering(scaled, field.tau, cosine);
  };
  const auto top = [&](double mu) { return exit_radiance_top(field, mu) + missing(-mu); };
  const auto bottom = [&](double mu) {
    return std::isinf(slab.tau) ? 0.0 : exit_radiance_bottom(field, mu) + missing(mu);
  };
  for (const double mu : places.mus) {
    solution.reflected_radiance.values.push_back(top(mu));
    solution.transmitted_radiance.values.push_back(bottom(mu));
  }
  solution.reflected_flux.values = bin_flux(places.mu_edges, top);
  solution.transmitted_flux.values = bin_flux(places.mu_edges, bottom);
  return solution;
}

constexpr double kRoundingOfModes = 1e-12;  // of sums of some hundred modes, relative to values of order 1
constexpr double kCaution = 4.0;            // errors oscillate with the number of ordinates: two can be close by chance

void bound(Bounded& fine, const Bounded& coarse) {
  fine.error = kCaution * std::fabs(fine.value - coarse.value) + kRoundingOfModes;
}
void bound(BoundedSeries& fine, const BoundedSeries& coarse) {
  double largest = 1.0;
  for (size_t i = 0; i < fine.values.size(); ++i) {
    fine.error = std::max(fine.error, std::fabs(fine.values[i] - coarse.values[i]));
    largest = std::max(largest, std::fabs(fine.values[i]));
  }
  fine.error = kCaution * fine.error + kRoundingOfModes * largest;
}

}  // namespace

SlabSolution solve_slab(const Slab& slab, const SlabPlaces& places) {
  assert(slab.tau > 0.0 && slab.albedo >= 0.0 && slab.albedo <= 1.0 && !slab.phase.empty());
  const int count = ordinate_count(slab.phase);
  SlabSolution fine = solve_with(count, slab, places);
  // Where a peak is cut off, errors are no longer small against their differences: compare with much fewer ordinates.
  const SlabSolution coarse = solve_with(count == kMostOrdinates ? count * 3 / 4 : count * 7 / 8, slab, places);
  bound(fine.reflected, coarse.reflected);
  bound(fine.transmitted, coarse.transmitted);
  bound(fine.absorbed, coarse.absorbed);
  bound(fine.fluence, coarse.fluence);
  bound(fine.net_flux, coarse.net_flux);
  bound(fine.reflected_radiance, coarse.reflected_radiance);
  bound(fine.transmitted_radiance, coarse.transmitted_radiance);
  bound(fine.reflected_flux, coarse.reflected_flux);
  bound(fine.transmitted_flux, coarse.transmitted_flux);
  return fine;
}

Bounded chandrasekhar_h(double albedo, double mu) {
  assert(albedo >= 0.0 && albedo <= 1.0 && mu >= 0.0 && mu <= 1.0);
  if (mu == 0.0 || albedo == 0.0) return {1.0, 0.0};
  // ln H = -(mu / pi) int_0^inf ln(1 - albedo atan(t) / t) / (1 + mu^2 t^2) dt [Chandrasekhar1960], with t = exp(x)
  const auto integrand = [&](double x) {
    const double t = std::exp(x);
    const double rest = t < 0.03 ? t * t * (1.0 / 3.0 - t * t * (1.0 / 5.0 - t * t * (1.0 / 7.0 - t * t / 9.0)))
                                 : 1.0 - std::atan(t) / t;  // 1 - atan(t) / t
    return std::log(1.0 - albedo + albedo * rest) * t / (1.0 + mu * mu * t * t);
  };
  const Bounded integral = integrate(integrand, -45.0, 45.0 - 2.0 * std::log(mu));
  const double h = std::exp(-mu / kPiD * integral.value);
  return {h, h * (mu / kPiD * integral.error + 1e-15)};
}

}  // namespace vpm::exact
