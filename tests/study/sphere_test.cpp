// Spheres against reference numbers, and against what holds exactly.
#include "vpm/study/exact/sphere.h"

#include <gtest/gtest.h>

#include <cmath>

#include "study/oracles.h"
#include "vpm/base/vec.h"
#include "vpm/study/exact/quadrature.h"

namespace vpm::exact {
namespace {

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
  EXPECT_EQ(compared, 12);
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
