// The point source against reference numbers, its two methods against each other, and what holds exactly.
#include "vpm/study/exact/point_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "study/oracles.h"
#include "vpm/base/vec.h"

namespace vpm::exact {
namespace {

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

}  // namespace
}  // namespace vpm::exact
