
#include "vpm/study/exact/phase_moments.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "vpm/base/overloads.h"
#include "vpm/base/vec.h"
#include "vpm/study/exact/quadrature.h"

namespace vpm::exact {

PhaseMoments isotropic_moments() { return {1.0}; }

PhaseMoments henyey_greenstein_moments(double g) {
  assert(std::fabs(g) <= 0.9999);
  PhaseMoments moments;
  for (double chi = 1.0; std::fabs(chi) > 1e-16; chi *= g) moments.push_back(chi);
  return moments;
}

PhaseMoments rayleigh_moments() { return {1.0, 0.0, 0.1}; }

PhaseMoments draine_moments(double g, double alpha) {
  const PhaseMoments powers = henyey_greenstein_moments(g);
  const auto power = [&](int l) { return l < static_cast<int>(powers.size()) ? powers[static_cast<size_t>(l)] : 0.0; };
  PhaseMoments moments;
  for (int l = 0; l < static_cast<int>(powers.size()) + 2; ++l) {
    // cos^2 P_l, by the recurrence of Legendre polynomials twice.
    const double n = l, up = (n + 1.0) * (n + 2.0) / ((2.0 * n + 1.0) * (2.0 * n + 3.0)),
                 same = (n + 1.0) * (n + 1.0) / ((2.0 * n + 1.0) * (2.0 * n + 3.0)) +
                        n * n / ((2.0 * n + 1.0) * (2.0 * n - 1.0)),
                 down = l < 2 ? 0.0 : n * (n - 1.0) / ((2.0 * n + 1.0) * (2.0 * n - 1.0));
    const double below = l < 2 ? 0.0 : power(l - 2);
    moments.push_back(power(l) + alpha * (up * power(l + 2) + same * power(l) + down * below));
  }
  const double total = moments.front();
  for (double& moment : moments) moment /= total;
  return moments;
}

PhaseMoments mixed_moments(const PhaseMoments& a, const PhaseMoments& b, double first) {
  PhaseMoments moments(std::max(a.size(), b.size()), 0.0);
  for (size_t l = 0; l < a.size(); ++l) moments[l] += first * a[l];
  for (size_t l = 0; l < b.size(); ++l) moments[l] += (1.0 - first) * b[l];
  return moments;
}

PhaseMoments table_moments(const PhaseTable& table) {
  constexpr size_t kMost = 2000;
  constexpr double kNegligible = 1e-8, kStep = 1.0 / PhaseTable::kCells;
  static const GaussRule rule = gauss_legendre(4);
  PhaseMoments moments(kMost, 0.0);
  for (int cell = 0; cell < PhaseTable::kCells; ++cell)
    for (size_t k = 0; k < rule.nodes.size(); ++k) {
      const double s = (cell + rule.nodes[k]) * kStep, x = 1.0 - 2.0 * s * s;
      const double share = rule.weights[k] * kStep * 8.0 * kPiD * s * double{table.value(static_cast<float>(s))};
      double p = 1.0, before = 0.0;
      for (size_t l = 0; l < kMost; ++l) {
        moments[l] += share * p;
        const double n = static_cast<double>(l), next = ((2.0 * n + 1.0) * x * p - n * before) / (n + 1.0);
        before = p;
        p = next;
      }
    }
  for (size_t l = kMost; l-- > 0;) moments[l] /= moments[0];
  while (moments.size() > 1 && std::fabs(moments.back()) < kNegligible) moments.pop_back();
  return moments;
}

PhaseMoments moments_of(const Phase& phase) {
  const auto of_lobe = [](const HenyeyGreenstein& lobe) { return henyey_greenstein_moments(double{lobe.g}); };
  const auto of_draine = [](const Draine& lobe) { return draine_moments(double{lobe.g}, double{lobe.alpha}); };
  return std::visit(
      Overloads{
          [](const Isotropic&) { return isotropic_moments(); }, [](const Rayleigh&) { return rayleigh_moments(); },
          of_lobe, of_draine,
          [&](const TwoLobes& both) { return mixed_moments(of_lobe(both.a), of_lobe(both.b), double{both.first}); },
          [&](const Droplets& both) { return mixed_moments(of_lobe(both.a), of_draine(both.b), double{both.first}); },
          [](const Tabulated& of) { return table_moments(*of.table); }},
      phase);
}

namespace {

/// sum (2l+1) chi_l P_l(x) / (4 pi).
double phase_sum(const PhaseMoments& moments, double x) {
  double sum = 0.0, p = 1.0, before = 0.0;
  for (size_t l = 0; l < moments.size(); ++l) {
    sum += (2.0 * l + 1.0) * moments[l] * p;
    const double next = ((2.0 * l + 1.0) * x * p - l * before) / (l + 1.0);
    before = p;
    p = next;
  }
  return sum / (4.0 * kPiD);
}

}  // namespace

TruncatedSlab truncate_forward_peak(double albedo, const PhaseMoments& phase, int orders) {
  const auto kept = static_cast<size_t>(orders);
  if (phase.size() <= kept) return {1.0, albedo, phase, {}};
  // Moments that fall off without changing sign belong to a forward peak; else nothing passes for unscattered light.
  const double peak = std::max(0.0, std::min(phase[kept - 1], phase[kept]));
  TruncatedSlab slab{1.0 - albedo * peak, 1.0, {}, phase};
  if (albedo < 1.0) slab.albedo = albedo * (1.0 - peak) / slab.depth_scale;
  for (size_t l = 0; l < kept; ++l) {
    slab.phase.push_back((phase[l] - peak) / (1.0 - peak));
    slab.missing[l] = peak;
  }
  for (double& moment : slab.missing) moment /= 1.0 - peak;
  return slab;
}

double missing_single_scattering(const TruncatedSlab& truncated, double tau, double cosine) {
  if (truncated.missing.empty()) return 0.0;
  const double mu = std::fabs(cosine), source = truncated.albedo * phase_sum(truncated.missing, cosine);
  if (cosine < 0.0) return source * -std::expm1(-tau * (1.0 + 1.0 / mu)) / (1.0 + mu);
  const double away = 1.0 / mu - 1.0;  // int_0^tau exp(-t - (tau - t) / mu) dt / mu
  return source * std::exp(-tau) * (away == 0.0 ? tau : -std::expm1(-tau * away) / (away * mu));
}

}  // namespace vpm::exact
