// Slabs against reference numbers, and against what holds exactly.
#include "vpm/study/exact/slab.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "study/oracles.h"
#include "vpm/base/vec.h"
#include "vpm/study/exact/special_functions.h"

namespace vpm::exact {
namespace {

constexpr double kHalfSpace = std::numeric_limits<double>::infinity();

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// Moments against integrals of the phase function times Legendre polynomials, by midpoints.
TEST(PhaseMoments, OfDraineAreIntegrals) {
  for (const auto& [g, alpha] : {std::pair{0.6, 20.0}, {-0.3, 1.0}, {0.0, 5.0}, {0.8, 0.0}}) {
    const PhaseMoments moments = draine_moments(g, alpha);
    constexpr int kSteps = 200'000;
    std::vector<double> sums(6, 0.0);
    for (int i = 0; i < kSteps; ++i) {
      const double x = 2.0 * (i + 0.5) / kSteps - 1.0;
      const double value = (1.0 + alpha * x * x) * (1.0 - g * g) / std::pow(1.0 + g * g - 2.0 * g * x, 1.5);
      for (unsigned l = 0; l < sums.size(); ++l) sums[l] += value * std::legendre(l, x);
    }
    for (size_t l = 1; l < sums.size(); ++l)
      EXPECT_NEAR(l < moments.size() ? moments[l] : 0.0, sums[l] / sums[0], 1e-8) << "moment " << l;
  }
  EXPECT_EQ(draine_moments(0.0, 1.0).at(2), rayleigh_moments().at(2));
}

TEST(ExactSlab, ReflectsAndTransmitsAsTheOracleSays) {
  for (const auto& oracle : oracle_cases("s4_slab_RT")) expect_slab_oracle(oracle);
}

TEST(ExactSlab, RadianceAndFluxInBinsAreTheOracles) {
  for (const auto& oracle : oracle_cases("s4_slab_angular")) {
    SCOPED_TRACE(oracle.at("id"));
    SlabPlaces places;
    places.mus = oracle.at("mu").get<std::vector<double>>();
    places.mu_edges = oracle.at("mu_bin_edges").get<std::vector<double>>();
    const SlabSolution ours = solve_slab(slab_of(oracle), places);
    const double error = oracle.at("abs_err");
    expect_all_near(ours.reflected_radiance.values, oracle.at("radiance_reflected"), error);
    expect_all_near(ours.transmitted_radiance.values, oracle.at("radiance_transmitted_scattered"), error);
    EXPECT_LT(ours.reflected_radiance.error, 1e-9);
    EXPECT_LT(ours.transmitted_radiance.error, 1e-9);

    // The oracle's bins are good to 1e-6, and as far as their sum is from the scattered flux (in one case 4e-6).
    const double scattered = ours.transmitted.value - ours.unscattered;
    const double off = total(oracle.at("flux_in_bin_transmitted_scattered")) - scattered;
    expect_all_near(ours.reflected_flux.values, oracle.at("flux_in_bin_reflected"), 1e-6);
    expect_all_near(ours.transmitted_flux.values, oracle.at("flux_in_bin_transmitted_scattered"), 1e-6 + std::abs(off));
    EXPECT_NEAR(total(ours.reflected_flux.values), ours.reflected.value, 1e-12);
    EXPECT_NEAR(total(ours.transmitted_flux.values), scattered, 1e-12);
  }
}

TEST(ExactSlab, FluenceAndNetFluxAreTheOracles) {
  for (const auto& oracle : oracle_cases("s4_slab_fluence")) {
    SCOPED_TRACE(oracle.at("id"));
    SlabPlaces places;
    places.depths = oracle.at("depth_tau").get<std::vector<double>>();
    const SlabSolution ours = solve_slab(slab_of(oracle), places);
    const double error = oracle.at("abs_err");
    expect_all_near(ours.fluence.values, oracle.at("fluence_total"), error);
    expect_all_near(ours.uncollided_fluence, oracle.at("fluence_uncollided"), 1e-14);
    expect_all_near(ours.net_flux.values, oracle.at("net_flux_down"), 1e-10);
    EXPECT_LT(ours.fluence.error, 1e-10);
    EXPECT_LT(ours.net_flux.error, 1e-11);
  }
}

// A slab whose extinction depends on depth is the same problem in optical depth.
TEST(ExactSlab, DepthVaryingSlabsAreTheOracles) {
  for (const auto& oracle : oracle_cases("s8_hetero_slab")) {
    SCOPED_TRACE(oracle.at("id"));
    SlabPlaces places;
    places.depths = oracle.at("tau_at_z").get<std::vector<double>>();
    const SlabSolution ours = solve_slab(slab_of(oracle), places);
    const double error = oracle.at("abs_err"), flux_error = oracle.at("abs_err_net_flux");
    EXPECT_NEAR(ours.reflected.value, oracle.at("R"), error);
    EXPECT_NEAR(ours.transmitted.value, oracle.at("T_total"), error);
    EXPECT_NEAR(ours.absorbed.value, oracle.at("A"), 2.0 * error);
    expect_all_near(ours.net_flux.values, oracle.at("net_flux"), flux_error);
    std::vector<double> absorbed;
    for (size_t i = 0; i + 1 < ours.net_flux.values.size(); ++i)
      absorbed.push_back(ours.net_flux.values[i] - ours.net_flux.values[i + 1]);
    expect_all_near(absorbed, oracle.at("absorbed_in_z_fifths"), 2.0 * flux_error);
  }
}

// [Hulst1980], as quoted by [Wang1995].
TEST(ExactSlab, MatchesAPublishedTable) {
  const SlabSolution slab = solve_slab({2.0, 0.9, henyey_greenstein_moments(0.75)});
  EXPECT_NEAR(slab.reflected.value, 0.09739, 5e-6);
  EXPECT_NEAR(slab.transmitted.value, 0.66096, 5e-6);
}

TEST(ExactSlab, NothingIsLostWithoutAbsorption) {
  for (const double tau : {1e-3, 0.1, 1.0, 30.0, 256.0, 1e4})
    for (const PhaseMoments& phase :
         {isotropic_moments(), rayleigh_moments(), henyey_greenstein_moments(0.9), henyey_greenstein_moments(-0.7)}) {
      SCOPED_TRACE(tau);
      SlabPlaces places{{0.0, 0.3 * tau, 0.9 * tau, tau}, {}, {}};
      const SlabSolution slab = solve_slab({tau, 1.0, phase, Incidence::diffuse}, places);
      EXPECT_NEAR(slab.absorbed.value, 0.0, slab.absorbed.error);
      EXPECT_LT(slab.absorbed.error, 1e-10);
      for (const double flux : slab.net_flux.values) EXPECT_NEAR(flux, slab.transmitted.value, slab.net_flux.error);
    }
}

// What is absorbed is (1 - albedo) times the fluence, summed over depth.
TEST(ExactSlab, FluenceAccountsForWhatIsAbsorbed) {
  const Slab slab{3.0, 0.8, henyey_greenstein_moments(0.6)};
  SlabPlaces places;
  constexpr int kSteps = 400;
  for (int i = 0; i <= kSteps; ++i) places.depths.push_back(3.0 * i / kSteps);
  const SlabSolution solution = solve_slab(slab, places);
  // Simpson's rule over the middle half, where fluence is smooth in depth.
  double sum = 0.0;
  for (int i = kSteps / 4; i < kSteps * 3 / 4; i += 2)
    sum += solution.fluence.values[i] + 4.0 * solution.fluence.values[i + 1] + solution.fluence.values[i + 2];
  sum *= 3.0 / kSteps / 3.0;
  EXPECT_NEAR((1.0 - slab.albedo) * sum,
              solution.net_flux.values[kSteps / 4] - solution.net_flux.values[kSteps * 3 / 4], 1e-10);
}

// Light takes the same way back: irradiance from everywhere returns along the normal what a beam along the normal
// returns to everywhere.
TEST(ExactSlab, IsReciprocal) {
  for (const double g : {0.0, -0.4, 0.85}) {
    const Slab beam{1.7, 0.93, henyey_greenstein_moments(g)};
    Slab diffuse = beam;
    diffuse.incidence = Incidence::diffuse;
    const SlabSolution there = solve_slab(beam), back = solve_slab(diffuse, {{}, {1.0}, {}});
    EXPECT_NEAR(kPiD * back.reflected_radiance.values[0], there.reflected.value, 1e-10);
    EXPECT_NEAR(kPiD * back.transmitted_radiance.values[0], there.transmitted.value - there.unscattered, 1e-10);
  }
}

// Also close to the surface, where the ordinates alone are poor.
TEST(ExactSlab, PureAbsorbersAttenuateAsExponentialIntegrals) {
  const SlabPlaces places{{1e-6, 1e-3, 1.0}, {0.5}, {}};
  const SlabSolution slab = solve_slab({2.5, 0.0, isotropic_moments(), Incidence::diffuse}, places);
  EXPECT_NEAR(slab.reflected.value, 0.0, 1e-12);
  EXPECT_NEAR(slab.transmitted.value, 2.0 * exponential_integral(3, 2.5), 1e-12);
  for (size_t i = 0; i < places.depths.size(); ++i) {
    EXPECT_NEAR(slab.fluence.values[i], 2.0 * exponential_integral(2, places.depths[i]), 1e-12);
    EXPECT_NEAR(slab.net_flux.values[i], 2.0 * exponential_integral(3, places.depths[i]), 1e-12);
  }
  EXPECT_EQ(slab.reflected_radiance.values[0], 0.0);
}

// The diffusion limit, with Hopf's constant [Chandrasekhar1960].
TEST(ExactSlab, ThickSlabsTransmitAsMilnesProblemSays) {
  const double tau = 500.0, hopf = 0.7104460896;
  const SlabSolution slab = solve_slab({tau, 1.0, isotropic_moments(), Incidence::diffuse});
  EXPECT_NEAR(slab.transmitted.value, 4.0 / 3.0 / (tau + 2.0 * hopf), 1e-12);
}

TEST(ExactSlab, IsotropicHalfSpacesFollowTheHFunction) {
  for (const double albedo : {0.01, 0.5, 0.9, 0.999, 1.0}) {
    SCOPED_TRACE(albedo);
    const std::vector<double> mus{0.01, 0.2, 0.7, 1.0};
    const SlabSolution half = solve_slab({kHalfSpace, albedo, isotropic_moments()}, {{}, mus, {}});
    const double h1 = chandrasekhar_h(albedo, 1.0).value;
    EXPECT_NEAR(half.reflected.value, 1.0 - std::sqrt(1.0 - albedo) * h1, 1e-11);
    EXPECT_EQ(half.transmitted.value, 0.0);
    for (size_t i = 0; i < mus.size(); ++i)  // [Chandrasekhar1960]: albedo / (4 pi) H(1) H(mu) / (1 + mu)
      EXPECT_NEAR(half.reflected_radiance.values[i],
                  albedo / (4.0 * kPiD) * h1 * chandrasekhar_h(albedo, mus[i]).value / (1.0 + mus[i]), 1e-11);
  }
  EXPECT_NEAR(chandrasekhar_h(1.0, 1.0).value, 2.9078105, 1e-7);
}

TEST(ExactSlab, ThickSlabsBecomeHalfSpaces) {
  for (const double g : {0.0, 0.9}) {
    const PhaseMoments phase = henyey_greenstein_moments(g);
    const SlabPlaces places{{0.0, 0.5, 5.0}, {0.1, 0.8}, {0.0, 0.5, 1.0}};
    const SlabSolution slab = solve_slab({2000.0, 0.95, phase}, places);
    const SlabSolution half = solve_slab({kHalfSpace, 0.95, phase}, places);
    EXPECT_NEAR(slab.reflected.value, half.reflected.value, 1e-12);
    for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(slab.fluence.values[i], half.fluence.values[i], 1e-11);
    for (size_t i = 0; i < 2; ++i)
      EXPECT_NEAR(slab.reflected_radiance.values[i], half.reflected_radiance.values[i], 1e-11);
    for (size_t i = 0; i < 2; ++i) EXPECT_NEAR(slab.reflected_flux.values[i], half.reflected_flux.values[i], 1e-11);
  }
}

// In a thin layer light scatters once, also by forward peaks too narrow for the ordinates. Backward ones are bounded
// only.
TEST(ExactSlab, ThinSlabsScatterOnce) {
  const double tau = 1e-4;
  const std::vector<double> mus{0.2, 0.5, 0.9};
  for (const double g : {0.5, 0.995, -0.995}) {
    const SlabSolution thin = solve_slab({tau, 1.0, henyey_greenstein_moments(g)}, {{}, mus, {}});
    const auto once = [&](double cosine) {
      return (1.0 - g * g) / (4.0 * kPiD * std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5)) * tau / std::fabs(cosine);
    };
    const double top = g < 0.0 ? thin.reflected_radiance.error : 0.0;
    const double bottom = g < 0.0 ? thin.transmitted_radiance.error : 0.0;
    for (size_t i = 0; i < mus.size(); ++i) {
      EXPECT_NEAR(thin.reflected_radiance.values[i], once(-mus[i]), 1e-3 * once(-mus[i]) + top) << g;
      EXPECT_NEAR(thin.transmitted_radiance.values[i], once(mus[i]), 1e-3 * once(mus[i]) + bottom) << g;
    }
  }
}

// What the ordinates leave out of a peak shows in the bounds.
TEST(ExactSlab, NarrowForwardPeaksAreBounded) {
  double error = 0.0;
  for (const double narrow : {0.95, 0.98, 0.995}) {
    const SlabSolution slab = solve_slab({4.0, 1.0, henyey_greenstein_moments(narrow)});
    EXPECT_NEAR(slab.absorbed.value, 0.0, 1e-11);
    EXPECT_GT(slab.reflected.error, error);
    error = slab.reflected.error;
  }
  EXPECT_LT(error, 1e-7);
}

}  // namespace
}  // namespace vpm::exact
