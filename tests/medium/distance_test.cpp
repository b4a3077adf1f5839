// Distance strategies: the exact law of free flights where a channel has no extinction, rates, weights, and what is the
// same flight by flight.
#include <gtest/gtest.h>

#include "support/grids.h"
#include "support/statistics.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/medium/distance/strategy.h"

namespace vpm {
namespace {

constexpr int kBins = 24;

/// What a flight deposits: per bin of distance, then leaving.
struct Deposits {
  std::vector<Moments> bins = std::vector<Moments>(kBins + 1);
  double weight = 0.0, squares = 0.0;
};

std::array<Deposits, 3> fly(const Medium& medium, const DistanceStrategy& strategy, int flights, const Rgb& power,
                            uint64_t stream) {
  std::array<Deposits, 3> result;
  for (int i = 0; i < flights; ++i) {
    Rng rng(7, rng_stream(RngUse::test, stream), static_cast<uint64_t>(i));
    const Flight flight = strategy.sample(medium, kRay, kReach, power, rng);
    const int bin = flight.collided ? std::min(kBins - 1, static_cast<int>(flight.t / kReach.t1 * kBins)) : kBins;
    for (int c = 0; c < 3; ++c) {
      for (int b = 0; b <= kBins; ++b) result[c].bins[b].add(b == bin ? flight.weight[c] : 0.0);
      result[c].weight += flight.weight[c];
      result[c].squares += double(flight.weight[c]) * flight.weight[c];
    }
  }
  return result;
}

double exact_probability(const Medium& medium, int channel, int bin) {
  const auto through = [&](int edge) {
    return std::exp(-double(medium.sigma_t[channel]) *
                    density_integral(medium, kRay, {0.0f, kReach.t1 * edge / kBins}).value);
  };
  return bin == kBins ? through(kBins) : through(bin) - through(bin + 1);
}

void expect_exact(const Medium& medium, const DistanceSettings& settings, const Rgb& power, const char* field,
                  bool bounded_weight) {
  constexpr int kFlights = 40000;
  const auto deposits = fly(medium, *make_distance_strategy(settings), kFlights, power, 1);
  for (int c = 0; c < 3; ++c) {
    const double sample_size = deposits[c].weight * deposits[c].weight / deposits[c].squares;
    if (sample_size < 1000.0) {  // heavy tails: a z-test would lie
      EXPECT_FALSE(bounded_weight) << settings.strategy << " on " << field;
      continue;
    }
    for (int b = 0; b <= kBins; ++b) {
      const double exact = exact_probability(medium, c, b);
      const Moments& m = deposits[c].bins[b];
      // The exact variance of a count bounds the estimate's where a rare bin saw too few.
      const double error = std::sqrt(std::max(m.variance_of_mean(), exact * (1.0 - exact) / kFlights));
      EXPECT_LT(std::abs(m.mean() - exact), normal_quantile(kFalseAlarms) * error + 1e-7)
          << settings.strategy << " on " << field << ", channel " << c << ", bin " << b << ": " << m.mean()
          << " against " << exact;
    }
  }
}

TEST(DistanceStrategy, AChannelWithoutExtinctionLeadsThroughAndWeighsTheOthers) {
  const Medium medium = make_medium(flight_fields()[4].grid, Rgb(0.0f, 1.5f, 3.0f));
  for (const StrategyInfo& info : distance_strategies())
    if (info.heterogeneous)
      expect_exact(medium,
                   {std::string(info.name),
                    among(info.parameters, {{"step", 0.1f}, {"optical_step", 0.02f}, {"majorant", 1.0f}})},
                   Rgb(1.0f, 0.5f, 2.0f), "gaussian", info.bounded_weight);
  // So thin that no sample size is too small, by a majorant that does not bound and powers of unlike sign.
  expect_exact(make_medium(flight_fields()[4].grid, Rgb(0.0f, 0.2f, 0.3f)), {"weighted", {{"majorant", 0.25f}}},
               Rgb(1.0f, -0.5f, 2.0f), "gaussian", true);
}

TEST(DistanceStrategy, HomogeneousEqualsAConstantGridFlightByFlight) {
  GridFrame frame;
  frame.lo = Vec3i(-50);
  frame.hi = Vec3i(50);
  const auto grid = make_grid(frame, [](int, int, int) { return 1.0; });
  const Interval inside{2.0f, 40.0f};
  for (const Rgb& sigma_t : {Rgb(0.1f), Rgb(0.02f, 0.1f, 0.4f)}) {
    const Medium constant = make_medium(grid, sigma_t);
    const Medium homogeneous = make_medium(nullptr, sigma_t);
    // Those that draw a flight's length by one number. The mean over the grid's support counts the voxel over which the
    // density fades, so that the rate of `mean-extinction` is not the medium's.
    for (const char* name : {"regular", "local-extinction", "ray-march", "ray-march-adaptive"}) {
      const DistanceSettings settings{.strategy = name};
      for (uint64_t i = 0; i < 2000; ++i) {
        Rng a(3, rng_stream(RngUse::test, 3), i), b(3, rng_stream(RngUse::test, 3), i);
        const Flight x =
            make_distance_strategy({.strategy = "homogeneous"})->sample(homogeneous, {}, inside, Rgb(1, 2, 3), a);
        const Flight y = make_distance_strategy(settings)->sample(constant, {}, inside, Rgb(1, 2, 3), b);
        ASSERT_EQ(x.collided, y.collided) << name;
        ASSERT_NEAR(x.t, y.t, 1e-4) << name;
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(x.weight[c], y.weight[c], 1e-5 * (1.0 + x.weight[c])) << name;
      }
    }
  }
}

TEST(DistanceStrategy, GreyWeightsOfAnalogStrategiesAreExactlyOne) {
  for (const StrategyInfo& info : distance_strategies()) {
    if (!info.bounded_weight) continue;
    const Medium medium = make_medium(info.heterogeneous ? flight_fields()[5].grid : nullptr, Rgb(2.0f));
    for (uint64_t i = 0; i < 1000; ++i) {
      Rng rng(3, rng_stream(RngUse::test, 4), i);
      const auto strategy = make_distance_strategy({.strategy = std::string(info.name)});
      EXPECT_EQ(strategy->sample(medium, kRay, kReach, Rgb(1.0f), rng).weight, Rgb(1.0f)) << info.name;
    }
  }
}

TEST(DistanceStrategy, ExponentialFlightsHaveTheirStatedRates) {
  // Weights forgive any rate: only the share of flights that collide tells it.
  const Medium medium = make_medium(flight_fields()[1].grid, Rgb(1.5f));
  const double mean = medium.mean_density();
  struct Case {
    const char* strategy;
    float t0;  // m; at 0 the ray is before the grid
    double density;
  };
  for (const Case& c : {Case{"mean-extinction", 1.3f, mean}, Case{"local-extinction", 0.0f, 0.3 * mean},
                        Case{"local-extinction", 1.3f, medium.density(kRay.at(1.3f))}}) {
    const auto strategy =
        make_distance_strategy({c.strategy, among(strategy_info(c.strategy).parameters, {{"extinction_floor", 0.3f}})});
    const Interval reach{c.t0, c.t0 + 0.9f};
    Moments collided;
    for (uint64_t i = 0; i < 40000; ++i) {
      Rng rng(3, rng_stream(RngUse::test, 6), i);
      const Flight flight = strategy->sample(medium, kRay, reach, Rgb(1.0f), rng);
      EXPECT_TRUE(flight.t >= reach.t0 && flight.t <= reach.t1);
      collided.add(flight.collided ? 1.0 : 0.0);
    }
    expect_mean(collided, 1.0 - std::exp(-1.5 * c.density * reach.length()), kFalseAlarms, c.strategy);
  }
}

TEST(DistanceStrategy, EndlessAndEmptyMediaGiveFiniteWeights) {
  const Interval endless;
  for (const StrategyInfo& info : distance_strategies())
    for (const Rgb& sigma_t : {Rgb(0.0f), Rgb(0.0f, 1.0f, 2.0f), Rgb(1e-12f, 1.0f, 2.0f), Rgb(1e-9f), Rgb(1e9f)}) {
      const Medium medium = make_medium(nullptr, sigma_t);
      for (uint64_t i = 0; i < 200; ++i) {
        Rng rng(3, rng_stream(RngUse::test, 5), i);
        const Flight f =
            make_distance_strategy({.strategy = std::string(info.name)})->sample(medium, {}, endless, Rgb(1.0f), rng);
        EXPECT_TRUE(is_finite(f.weight)) << info.name << " sigma_t " << sigma_t.r;
        EXPECT_EQ(f.collided, f.t < kInfinity) << info.name;
        EXPECT_FALSE(is_black(sigma_t) && f.collided) << info.name;
      }
    }
}

}  // namespace
}  // namespace vpm
