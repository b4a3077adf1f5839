// Transmittance estimators: how much noise they have, and how often they look.
#include <gtest/gtest.h>

#include "support/grids.h"
#include "support/statistics.h"
#include "vpm/medium/transmittance/estimator.h"

namespace vpm {
namespace {

const Ray kRay{Vec3(-3.0f, 0.4f, 0.2f), glm::normalize(Vec3(1.0f, -0.1f, 0.05f))};

std::shared_ptr<const DensityGrid> blob() {
  const GridFrame frame = centered_frame(20, 0.05);
  return make_grid(frame, [](int x, int y, int z) { return std::exp(-0.01 * (x * x + y * y + z * z)); });
}

TEST(Transmittance, EndsWithTheInterval) {
  Rng rng(1, 0, 0);
  for (const EstimatorInfo& info : transmittance_estimators()) {
    const auto estimator = make_transmittance_estimator({.estimator = std::string(info.name)});
    const auto through = [&](const Medium& medium, const Interval& interval) {
      return estimator->estimate(medium, kRay, interval, rng).value;
    };
    EXPECT_EQ(through(make_medium(nullptr, Rgb(2.0f, 0.0f, 1.0f)), {1.0f, kInfinity}), Rgb(0, 1, 0)) << info.name;
    EXPECT_EQ(through(make_medium(blob(), Rgb(2.0f)), {10.0f, kInfinity}), Rgb(1.0f)) << info.name;
    EXPECT_EQ(through(make_medium(blob(), Rgb(0.0f)), {0.0f, 6.0f}), Rgb(1.0f)) << info.name;
    EXPECT_EQ(through(make_medium(nullptr, Rgb(2.0f)), {1.0f, 1.0f}), Rgb(1.0f)) << info.name;
  }
}

TEST(Transmittance, AConstantMediumLeavesNoNoiseButThatOfRatioTracking) {
  const Medium medium = make_medium(nullptr, Rgb(2.0f));
  for (const EstimatorInfo& info : transmittance_estimators()) {
    const auto estimator = make_transmittance_estimator({.estimator = std::string(info.name)});
    Moments m;
    for (uint64_t i = 0; i < 20000; ++i) {
      Rng rng(3, rng_stream(RngUse::test, 0), i);
      m.add(estimator->estimate(medium, kRay, {1.0f, 1.5f}, rng).value.r);
    }
    if (info.name == "ratio" || info.name == "ratio-local") {
      EXPECT_NEAR(m.variance(), m.mean() * (1.0 - m.mean()), 1e-3);  // 0 or 1
      expect_mean(m, std::exp(-1.0), 1e-6);
    } else {
      EXPECT_LT(std::sqrt(m.variance()), 1e-7) << info.name;
      EXPECT_NEAR(m.mean(), std::exp(-1.0), 1e-7) << info.name;
    }
  }
}

/// Fields that vary in other ways, each with a stretch of the ray: smooth; values of single voxels; and bricks that are
/// empty or nearly so.
struct Field {
  const char* name;
  std::shared_ptr<const DensityGrid> grid;
  Interval stretch;
};
std::vector<Field> fields() {
  const GridFrame voxels = centered_frame(20, 0.05, Interpolation::nearest);
  return {{"blob", blob(), {0.0f, 6.0f}},
          {"voxels", make_grid(voxels, [](int x, int y, int z) { return lattice_noise(x, y, z); }), {0.0f, 6.0f}},
          {"sheets", make_grid(voxels, [](int x, int, int) { return x == -9 || x == 14 ? 3.0 : 0.0; }), {0.0f, 6.0f}}};
}

/// Means over independent estimates; second moments after the channels'.
std::vector<Moments> estimates(const TransmittanceSettings& settings, const Medium& medium, const Interval& stretch,
                               uint64_t count) {
  const auto estimator = make_transmittance_estimator(settings);
  std::vector<Moments> moments(6);
  for (uint64_t i = 0; i < count; ++i) {
    Rng rng(5, rng_stream(RngUse::test, 0), i);
    const Rgb value = estimator->estimate(medium, kRay, stretch, rng).value;
    for (int c = 0; c < 3; ++c) {
      moments[c].add(value[c]);
      moments[3 + c].add(double{value[c]} * value[c]);
    }
  }
  return moments;
}

TEST(Transmittance, TrackingHasTheVarianceOfItsPoissonProcess) {
  // The mean of the squared product is that of a process of the same rate with the squared shares: T^2 exp(int
  // residual^2 / rate), but for the roulette below 1 %, which this medium hardly plays.
  const Medium medium = make_medium(blob(), Rgb(1.5f));
  const Interval stretch{0.0f, 6.0f};
  const double exact = std::exp(-2.0 * 1.5 * density_integral(medium, kRay, stretch).value);
  double of_local = 0.0, of_global = 0.0, of_residual = 0.0;  // exponents by the midpoint rule
  medium.visit_majorants(kRay, medium.clip(kRay, stretch), [&](const DensityStretch& in) {
    constexpr int kSteps = 20000;
    const double control = 0.5 * (double{in.max} + in.min), reach = 0.5 * (double{in.max} - in.min);
    const double weight = 1.5 * (in.t1 - in.t0) / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      const double t = in.t0 + (i + 0.5) / kSteps * (in.t1 - in.t0);
      const double density = medium.density(kRay.at(static_cast<float>(t)));
      of_global += weight * density * density / medium.max_density();
      of_local += weight * density * density / in.max;
      of_residual += weight * (density - control) * (density - control) / reach;
    }
    return true;
  });
  const auto square = [&](const char* estimator) {
    return estimates({.estimator = estimator}, medium, stretch, 400000)[3];
  };
  expect_mean(square("ratio"), exact * std::exp(of_global), 1e-6, "ratio");
  expect_mean(square("ratio-local"), exact * std::exp(of_local), 1e-6, "ratio-local");
  expect_mean(square("residual-ratio"), exact * std::exp(of_residual), 1e-6, "residual-ratio");
}

/// Density 0.8 + 0.6 x along x, x from -1 to 1 m, and a ray along it.
Medium ramp(const Rgb& sigma_t) {
  const GridFrame frame = centered_frame(10, 0.1);
  return make_medium(make_grid(frame, [](int x, int, int) { return 0.8 + 0.06 * x; }), sigma_t);
}
const Ray kAlongRamp{Vec3(-0.9f, 0.2f, 0.1f), Vec3(1, 0, 0)};

TEST(Transmittance, TheUnbiasedMarchHasNoNoiseOnAStraightLine) {
  const Medium medium = ramp(Rgb(1.0f, 4.0f, 10.0f));
  const Interval stretch{0.1f, 1.7f};
  const double exact = density_integral(medium, kAlongRamp, stretch).value;
  const auto estimator = make_transmittance_estimator({.estimator = "unbiased-ray-march"});
  for (uint64_t i = 0; i < 1000; ++i) {
    Rng rng(2, rng_stream(RngUse::test, 0), i);
    const Rgb value = estimator->estimate(medium, kAlongRamp, stretch, rng).value;
    for (int c = 0; c < 3; ++c) {
      const double truth = std::exp(-medium.sigma_t[c] * exact);
      ASSERT_NEAR(value[c] / truth, 1.0, 1e-5);
    }
  }
}

TEST(Transmittance, TheUnbiasedMarchStopsItsSeriesAsThePaperHasIt) {
  // In a constant medium a comb has one sample, and two more are at the ends. Order k is reached with probability 0.1
  // 2^(k - 1) / k!, k > 0, so that the mean order is the sum of these.
  double mean_order = 0.0, reached = 0.1;
  for (int k = 1; k < 30; ++k, reached *= k == 2 ? 1.0 : 2.0 / k) mean_order += reached;
  EXPECT_NEAR(1.0 + mean_order, 1.31945, 1e-5);
  const auto estimator = make_transmittance_estimator({.estimator = "unbiased-ray-march"});
  Moments lookups;
  for (uint64_t i = 0; i < 400000; ++i) {
    Rng rng(4, rng_stream(RngUse::test, 0), i);
    lookups.add(estimator->estimate(make_medium(nullptr, Rgb(1.0f)), kRay, {0.0f, 1.0f}, rng).lookups);
  }
  expect_mean(lookups, 3.0 + mean_order, 1e-6);
}

TEST(Transmittance, MarchesLookOnceAStepTheJackknifeTwice) {
  const Medium medium = ramp(Rgb(4.0f));
  const Interval stretch{0.1f, 1.7f};
  Rng rng(6, rng_stream(RngUse::test, 0), 0);
  for (const uint32_t steps : {1u, 2u, 4u})
    for (const auto& [name, looks] : {std::pair("ray-march", 1u), {"jackknife", 2u}}) {
      const float step = 1.0001f * stretch.length() / static_cast<float>(steps) / medium.voxel_size();  // voxels
      const auto estimator = make_transmittance_estimator({name, {{"step", step}}});
      EXPECT_EQ(estimator->estimate(medium, kAlongRamp, stretch, rng).lookups, looks * steps) << name;
    }
}

TEST(Transmittance, ValuesBeyondZeroAndOneAreGivenAsTheyAre) {
  const Field sheets = fields().back();
  const Medium medium = make_medium(sheets.grid, Rgb(4.0f));
  const auto beyond = [&](const TransmittanceSettings& settings) {
    const auto estimator = make_transmittance_estimator(settings);
    std::pair<int, int> count{0, 0};
    for (uint64_t i = 0; i < 20000; ++i) {
      Rng rng(7, rng_stream(RngUse::test, 0), i);
      const float value = estimator->estimate(medium, kRay, sheets.stretch, rng).value.r;
      EXPECT_TRUE(std::isfinite(value));
      count.first += value < -1e-6f;
      count.second += value > 1.00001f;
    }
    return count;
  };
  const auto march = beyond({"unbiased-ray-march", {{"samples", 0.5f}}});
  EXPECT_GT(march.first, 0);
  EXPECT_GT(march.second, 0);
  EXPECT_GT(beyond({.estimator = "residual-ratio"}).second, 0);
  EXPECT_GT(beyond({"jackknife", {{"step", 20.0f}}}).first, 0);
  for (const char* name : {"regular", "ratio", "ratio-local", "ray-march"})
    EXPECT_EQ(beyond({.estimator = name}), std::pair(0, 0)) << name;
}

TEST(Transmittance, TrackingLooksAsOftenAsItsMajorantsSay) {
  // So thin that roulette, which ends a ray early, is hardly ever played.
  const Medium medium = make_medium(fields()[2].grid, Rgb(0.1f));
  const Interval stretch{0.0f, 6.0f}, inside = medium.clip(kRay, stretch);
  double local = 0.0, residual = 0.0;
  medium.visit_majorants(kRay, inside, [&](const DensityStretch& in) {
    local += 0.1 * (in.t1 - in.t0) * in.max;
    residual += 0.1 * (in.t1 - in.t0) * 0.5 * (double{in.max} - in.min);
    return true;
  });
  const auto expect_lookups = [&](const char* name, double mean) {
    const auto estimator = make_transmittance_estimator({.estimator = name});
    Moments lookups;
    for (uint64_t i = 0; i < 100000; ++i) {
      Rng rng(8, rng_stream(RngUse::test, 0), i);
      lookups.add(estimator->estimate(medium, kRay, stretch, rng).lookups);
    }
    expect_mean(lookups, mean, 1e-6, name);
  };
  expect_lookups("ratio", 0.1 * (double{inside.t1} - inside.t0) * medium.max_density());
  expect_lookups("ratio-local", local);
  expect_lookups("residual-ratio", residual);
  EXPECT_LT(residual, 0.51 * local);
}

}  // namespace
}  // namespace vpm
