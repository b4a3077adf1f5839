// Airlight, point sources and spheres against reference numbers, and against what holds exactly; the two methods of the
// point source against each other.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "study/oracles.h"
#include "vpm/base/vec.h"
#include "vpm/study/exact/airlight.h"
#include "vpm/study/exact/point_source.h"
#include "vpm/study/exact/quadrature.h"
#include "vpm/study/exact/sphere.h"

namespace vpm::exact {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

TEST(ExactAirlight, IsAsTheOracleSays) {
  for (const auto& oracle : oracle_cases("s3_airlight")) {
    SCOPED_TRACE(oracle.at("id"));
    const double t1 = oracle.at("t1").is_string() ? kEndless : oracle.at("t1").get<double>();
    const AirlightSolution ours = solve_airlight({oracle.at("sigma_t"), oracle.at("albedo"), oracle.at("g"),
                                                  oracle.at("d"), oracle.at("t_l"), oracle.at("t0"), t1});
    const double error = oracle.at("rel_err").get<double>() + 2e-13, log10_l = oracle.at("log10_L");
    EXPECT_NEAR(ours.radiance.value, oracle.at("L"), error * ours.radiance.value);
    EXPECT_LE(ours.radiance.error, 2e-12 * ours.radiance.value);
    EXPECT_NEAR(ours.log10_radiance, log10_l, 2e-14 * std::abs(log10_l) + 1e-13);
  }
}

// In a medium too thin to attenuate, isotropic scattering over the whole ray has the closed form sigma_s (pi - psi0) /
// (4 pi d), psi0 the angle at which the source sees the camera.
TEST(ExactAirlight, ThinMediaHaveAClosedForm) {
  const double d = 0.7, closest = 2.0, sigma_t = 1e-14;
  const AirlightSolution ours = solve_airlight({sigma_t, 1.0, 0.0, d, closest, 0.0, kEndless});
  const double psi0 = std::atan2(d, closest);
  EXPECT_NEAR(ours.radiance.value, sigma_t * (kPiD - psi0) / (4.0 * kPiD * d), 1e-11 * ours.radiance.value);
}

// The integral as it stands, without our substitution.
TEST(ExactAirlight, IsTheIntegralOverTheRay) {
  for (const double g : {-0.9, 0.0, 0.6}) {
    const Airlight a{1.3, 0.8, g, 0.4, 0.9, 0.2, 2.5};
    const Bounded direct = integrate(
        [&](double t) {
          const double r = std::hypot(a.distance, t - a.closest), cosine = (a.closest - t) / r;
          const double phase = (1.0 - g * g) / (4.0 * kPiD * std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
          return a.albedo * a.sigma_t * phase * std::exp(-a.sigma_t * (t + r)) / (r * r);
        },
        a.t0, a.t1);
    const Bounded ours = solve_airlight(a).radiance;
    EXPECT_NEAR(ours.value, direct.value, ours.error + direct.error);
  }
}

// The same of a beam's closed form, from behind, aside and into a narrow peak.
TEST(ExactAirlight, OfABeamIsTheIntegralOverTheChord) {
  for (const auto& [g, cosine] : {std::pair(0.0, 0.9), std::pair(-0.4, 0.0), std::pair(0.999, -0.9999)}) {
    const BeamAirlight a{0.02, 0.8, g, 0.5, cosine, 50.0, 40.0};
    const double half = a.beam_radius / std::sqrt(1.0 - cosine * cosine);
    const double phase = (1.0 - g * g) / (4.0 * kPiD * std::pow(1.0 + g * g + 2.0 * g * cosine, 1.5));
    const Bounded direct = integrate(
        [&](double t) {
          return a.albedo * a.sigma_t * phase * std::exp(-a.sigma_t * (a.flown + t * cosine + a.seen + t));
        },
        -half, half);
    const Bounded ours = solve_beam_airlight(a);
    EXPECT_NEAR(ours.value, direct.value, ours.error + direct.error + 1e-12 * direct.value);
  }
}

TEST(ExactAirlight, StretchesAddUp) {
  Airlight whole{2.0, 0.9, 0.99, 1e-3, 1.0, 0.0, kEndless}, near = whole, far = whole;
  near.t1 = far.t0 = 1.0005;
  const double sum = solve_airlight(near).radiance.value + solve_airlight(far).radiance.value;
  EXPECT_NEAR(sum, solve_airlight(whole).radiance.value, 1e-12 * sum);
}

/// Cases of one albedo and g share a solution.
std::map<std::pair<double, double>, std::vector<nlohmann::json>> cases_by_medium() {
  std::map<std::pair<double, double>, std::vector<nlohmann::json>> groups;
  for (const auto& oracle : oracle_cases("s2_point_source"))
    groups[{oracle.at("albedo"), oracle.at("g")}].push_back(oracle);
  return groups;
}

void expect_oracle(const PointSourceSolution& ours, const std::vector<nlohmann::json>& cases) {
  for (size_t i = 0; i < cases.size(); ++i) {
    const nlohmann::json& oracle = cases[i];
    SCOPED_TRACE(oracle.at("id"));
    EXPECT_NEAR(ours.uncollided[i], oracle.at("phi_uncollided"), 1e-15 * ours.uncollided[i]);
    EXPECT_NEAR(ours.collided[i].value, oracle.at("phi_collided"),
                oracle.at("abs_err_phi").get<double>() + ours.collided[i].error);
    EXPECT_LT(ours.collided[i].error, 2e-9 * ours.collided[i].value);
    // A digit beyond the estimate of the oracle, whose absorption is subtracted from 1 in some rows.
    EXPECT_NEAR(
        ours.collisions[i].value, oracle.at("collisions_within"),
        oracle.at("abs_err_collisions").get<double>() + ours.collisions[i].error + 1e-12 * ours.collisions[i].value);
    EXPECT_LT(ours.collisions[i].error, 2e-11 * ours.collisions[i].value);
  }
}

TEST(ExactPointSource, IsAsTheOracleSays) {
  for (const auto& [medium, cases] : cases_by_medium()) {
    std::vector<double> radii;
    for (const auto& oracle : cases) radii.push_back(oracle.at("r_optical"));
    expect_oracle(solve_point_source(medium.first, oracle_phase(cases[0]), radii), cases);
  }
}

TEST(ExactPointSource, CaseAndPnAgree) {
  const std::vector<double> radii{0.05, 0.3, 1.0, 10.0};
  for (const double albedo : {0.02, 0.7, 1.0}) {
    const PointSourceSolution a = point_source_case(albedo, radii);
    const PointSourceSolution b = point_source_pn(albedo, isotropic_moments(), radii);
    for (size_t i = 0; i < radii.size(); ++i) {
      EXPECT_NEAR(a.collided[i].value, b.collided[i].value, a.collided[i].error + b.collided[i].error);
      EXPECT_NEAR(a.collisions[i].value, b.collisions[i].value, a.collisions[i].error + b.collisions[i].error);
    }
  }
}

// Every photon ends in an absorption: (1 - albedo) times all collisions is 1.
TEST(ExactPointSource, AllLightIsAbsorbedInTheEnd) {
  for (const double albedo : {0.0, 1e-3, 0.5, 0.99})
    EXPECT_NEAR((1.0 - albedo) * point_source_case(albedo, {1e3}).collisions[0].value, 1.0, 1e-12);
  EXPECT_NEAR(0.1 * point_source_pn(0.9, henyey_greenstein_moments(0.7), {1e3}).collisions[0].value, 1.0, 1e-11);
}

// Collisions per radius are 4 pi r^2 times fluence: a central difference over a small step.
TEST(ExactPointSource, CollisionsAreTheIntegralOfFluence) {
  const double r = 1.3, h = 1e-3;
  const PointSourceSolution s = solve_point_source(0.8, henyey_greenstein_moments(0.5), {r - h, r, r + h});
  const double slope = (s.collisions[2].value - s.collisions[0].value) / (2.0 * h);
  EXPECT_NEAR(slope, 4.0 * kPiD * r * r * (s.uncollided[1] + s.collided[1].value), 1e-5);
}

// Far away without absorption, fluence is that of diffusion: 3 (1 - g) / (4 pi r).
TEST(ExactPointSource, ConservingMediaDiffuse) {
  const double r = 200.0, g = 0.6;
  const PointSourceSolution s = point_source_pn(1.0, henyey_greenstein_moments(g), {r});
  EXPECT_NEAR(s.collided[0].value, 3.0 * (1.0 - g) / (4.0 * kPiD * r), 1e-13);
}

// albedo atanh(k0) = k0 near its two ends, where plain forms cancel: the solution must not jump.
TEST(ExactPointSource, IsContinuousInAlbedo) {
  const double a = point_source_case(1.0 - 1e-12, {2.0}).collided[0].value;
  const double b = point_source_case(1.0, {2.0}).collided[0].value;
  EXPECT_NEAR(a, b, 1e-5 * b);  // changes by sqrt(3 (1 - albedo)) r
  EXPECT_GT(b, a);
  const double thin = point_source_case(1e-6, {2.0}).collided[0].value;
  EXPECT_NEAR(point_source_case(2e-6, {2.0}).collided[0].value, 2.0 * thin, 1e-5 * thin);
}

TEST(ExactSphere, IsAsTheOracleSays) {
  int compared = 0;
  for (const auto& oracle : oracle_cases("s5_furnace")) {
    if (oracle.at("g") != 0.0) continue;
    SCOPED_TRACE(oracle.at("id"));
    ++compared;
    const SphereSolution ours =
        solve_sphere(oracle.at("R_optical"), oracle.at("albedo"), oracle.at("fluence_r_over_R"), oracle.at("image_p"));
    const double error = oracle.at("abs_err");
    EXPECT_NEAR(ours.escaping.value, oracle.at("escape_fraction"), error);
    EXPECT_NEAR(ours.absorbed.value, oracle.at("absorbed_fraction"), error);
    EXPECT_NEAR(ours.uncollided, oracle.at("uncollided_fraction"), 1e-15);
    EXPECT_LT(ours.escaping.error, 1e-12);
    expect_all_near(ours.fluence.values, oracle.at("fluence"), 4.0 * kPiD * 1e-9);
    EXPECT_LT(ours.fluence.error, 1e-9);
    expect_all_near(ours.image.values, oracle.at("image_radiance"), 3e-7);
    EXPECT_LT(ours.image.error, 1e-11);
  }
  EXPECT_EQ(compared, 7);
}

TEST(ExactSphere, IsInvisibleWithoutAbsorption) {
  for (const double radius : {1e-3, 1.0, 1e5}) {
    const SphereSolution sphere = solve_sphere(radius, 1.0, {0.0, 0.4, 1.0}, {0.0, 0.5, 0.999, 1.0});
    EXPECT_EQ(sphere.escaping.value, 1.0);
    for (const double phi : sphere.fluence.values) EXPECT_NEAR(phi, 4.0 * kPiD, 1e-9);
    for (const double radiance : sphere.image.values) EXPECT_NEAR(radiance, 1.0, 1e-11);
  }
}

// All rays are alike: the mean of the image over the disc is the share of power that leaves.
TEST(ExactSphere, ItsImageAveragesToWhatEscapes) {
  for (const double albedo : {0.5, 0.97})
    for (const double radius : {0.1, 8.0}) {
      const GaussRule rule = gauss_legendre(16);
      std::vector<double> impacts;  // p^2 = 1 - x^4: gathered at the rim
      for (const double x : rule.nodes) impacts.push_back(std::sqrt((1.0 - x * x) * (1.0 + x * x)));
      const SphereSolution sphere = solve_sphere(radius, albedo, {}, impacts);
      double mean = 0.0;
      for (size_t i = 0; i < impacts.size(); ++i)
        mean += rule.weights[i] * 4.0 * std::pow(rule.nodes[i], 3) * sphere.image.values[i];
      EXPECT_NEAR(mean, sphere.escaping.value, 1e-12);
    }
}

TEST(ExactSphere, ThinSpheresAbsorbAlongTheirMeanChord) {
  const double radius = 1e-4, albedo = 0.3;
  EXPECT_NEAR(solve_sphere(radius, albedo).absorbed.value, (1.0 - albedo) * 4.0 / 3.0 * radius, 1e-7);
}

}  // namespace
}  // namespace vpm::exact
