// Transmittance estimators against the exact column.
#include <gtest/gtest.h>

#include "medium/transmittance/estimator.h"
#include "support/grids.h"
#include "support/statistics.h"

namespace vpm {
namespace {

const Ray kRay{Vec3(-3.0f, 0.4f, 0.2f), glm::normalize(Vec3(1.0f, -0.1f, 0.05f))};

std::shared_ptr<const DensityGrid> blob() {
  GridFrame frame;
  frame.lo = Vec3i(-20);
  frame.hi = Vec3i(20);
  frame.index_to_world = glm::scale(Mat4d(1.0), Vec3d(0.05));
  return make_grid(frame, [](int x, int y, int z) { return std::exp(-0.01 * (x * x + y * y + z * z)); });
}

TEST(Transmittance, RegularIsTheGaussianIntegral) {
  const Medium medium = make_medium(blob(), Rgb(0.5f, 1.0f, 4.0f));
  const auto estimator = make_transmittance_estimator({.estimator = "regular"});
  Rng rng(1, 0, 0);
  const Ray ray{Vec3(-3.0f, 0.0f, 0.0f), Vec3(1, 0, 0)};
  const Rgb t = estimator->estimate(medium, ray, {0.0f, 6.0f}, rng).value;
  // The lattice's trapezoidal sum of the bell, cut at 1 m, times the voxel.
  double sum = 0.0;
  for (int x = -20; x <= 20; ++x) sum += std::exp(-0.01 * x * x) * 0.05;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(t[c], std::exp(-medium.sigma_t[c] * sum), 1e-6);
}

TEST(Transmittance, RayMarchedBiasFallsWithTheSquareOfTheStep) {
  const Medium medium = make_medium(blob(), Rgb(2.0f));
  const double exact = std::exp(-2.0 * column(medium, kRay, {0.0f, 6.0f}).value);
  const auto bias = [&](float step) {
    const auto estimator = make_transmittance_estimator({.estimator = "ray-march", .step = step});
    Moments m;
    for (uint64_t i = 0; i < 40000; ++i) {
      Rng rng(5, rng_stream(RngUse::test, 0), i);
      m.add(estimator->estimate(medium, kRay, {0.0f, 6.0f}, rng).value.r - exact);
    }
    return m;
  };
  const Moments coarse = bias(40.0f);
  EXPECT_GT(coarse.mean(), 10.0 * std::sqrt(coarse.variance_of_mean()));  // seen: the exponential is convex
  const Moments fine = bias(8.0f);
  EXPECT_LT(std::abs(fine.mean()), coarse.mean() / 10.0);
}

TEST(Transmittance, EndsWithTheInterval) {
  const Medium medium = make_medium(nullptr, Rgb(2.0f));
  Rng rng(1, 0, 0);
  for (const EstimatorInfo& info : transmittance_estimators()) {
    const auto estimator = make_transmittance_estimator({.estimator = std::string(info.name)});
    EXPECT_FLOAT_EQ(estimator->estimate(medium, kRay, {1.0f, 1.5f}, rng).value.r, std::exp(-1.0f)) << info.name;
    EXPECT_EQ(estimator->estimate(medium, kRay, {1.0f, kInfinity}, rng).value.r, 0.0f) << info.name;
    EXPECT_EQ(estimator->estimate(make_medium(blob(), Rgb(2.0f)), kRay, {10.0f, kInfinity}, rng).value.r, 1.0f)
        << info.name;
  }
}

}  // namespace
}  // namespace vpm
