// Tracking through null collisions, what its majorants cost, and the march by local majorants: what the law of flights,
// which distance_test.cpp sees to, does not tell.
#include <gtest/gtest.h>

#include "support/grids.h"
#include "support/statistics.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/medium/distance/null_collisions.h"
#include "vpm/medium/distance/strategy.h"

namespace vpm {
namespace {

constexpr uint64_t kFlights = 20000;

Flight fly(const DistanceStrategy& strategy, const Medium& medium, uint64_t number) {
  Rng rng(5, rng_stream(RngUse::test, 0), number);
  return strategy.sample(medium, kRay, kReach, Rgb(1.0f, 0.5f, 2.0f), rng);
}

void expect_same(const Flight& a, const Flight& b) {
  EXPECT_EQ(a.t, b.t);
  EXPECT_EQ(a.collided, b.collided);
  EXPECT_EQ(a.density, b.density);
  EXPECT_EQ(a.weight, b.weight);
  EXPECT_EQ(a.null_collisions, b.null_collisions);
}

/// The mean number of null collisions of a flight, by the midpoint rule along the ray: the excess of the majorant,
/// where the flight still is.
double mean_null_collisions(const Medium& medium, bool local) {
  constexpr int kSteps = 20000;
  const double step = double{kReach.t1} / kSteps, sigma_t = medium.sigma_t.r;
  const Interval inside = medium.clip(kRay, kReach);
  double sum = 0.0, integral = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * step, density = medium.density(kRay.at(static_cast<float>(t)));
    double majorant = t > inside.t0 && t < inside.t1 ? medium.max_density() : 0.0;
    if (local) {
      majorant = 0.0;
      medium.visit_majorants(kRay, kReach, [&](const DensityStretch& stretch) {
        if (t > stretch.t0 && t < stretch.t1) majorant = stretch.max;
        return true;
      });
    }
    sum += sigma_t * (majorant - density) * std::exp(-sigma_t * (integral + 0.5 * density * step)) * step;
    integral += density * step;
  }
  return sum;
}

TEST(Tracking, MeetsAsManyNullCollisionsAsItsMajorantsAreTooHigh) {
  for (const FlightField& field : flight_fields()) {
    const Medium medium = make_medium(field.grid, Rgb(2.0f));
    for (const char* name : {"delta", "delta-local", "decomposition"}) {
      const auto strategy = make_distance_strategy({.strategy = name});
      Moments nulls;
      for (uint64_t i = 0; i < kFlights; ++i) {
        const Flight flight = fly(*strategy, medium, i);
        nulls.add(flight.null_collisions);
        EXPECT_EQ(flight.majorant_violations, 0u);
        EXPECT_LE(flight.lookups, flight.null_collisions + flight.collided);
        EXPECT_GE(flight.lookups,
                  std::string(name) == "delta" ? flight.null_collisions + flight.collided : uint64_t{flight.collided});
      }
      const double exact = mean_null_collisions(medium, std::string(name) != "delta");
      EXPECT_LT(std::abs(nulls.mean() - exact),
                normal_quantile(kFalseAlarms) * std::sqrt(nulls.variance_of_mean()) + 1e-3)
          << name << " on " << field.name << ": " << nulls.mean() << " against " << exact;
    }
  }
}

/// The density integral that a flight tells, where its strategy knows it, is that up to its end.
TEST(Tracking, FlightsTellTheirDensityIntegral) {
  const auto expect_told = [](const char* name, const Medium& medium) {
    const auto strategy = make_distance_strategy({.strategy = name});
    for (uint64_t i = 0; i < 2000; ++i) {
      const Flight flight = fly(*strategy, medium, i);
      const double exact = density_integral(medium, kRay, {kReach.t0, flight.t}).value;
      EXPECT_NEAR(flight.integral, exact, 1e-5 * (1.0 + exact)) << name;
    }
  };
  for (const FlightField& field : flight_fields())
    expect_told("regular", make_medium(field.grid, Rgb(0.5f, 1.5f, 3.0f)));
  expect_told("regular", make_medium(nullptr, Rgb(0.5f, 1.5f, 3.0f)));
  expect_told("homogeneous", make_medium(nullptr, Rgb(0.5f, 1.5f, 3.0f)));
  const Flight tracked = fly(*make_distance_strategy({.strategy = "delta"}), make_medium(nullptr, Rgb(2.0f)), 0);
  EXPECT_EQ(tracked.integral, kNotKnown);
}

TEST(Tracking, DecompositionFliesAsDeltaTrackingWithFewerLookUps) {
  for (const FlightField& field : flight_fields())
    for (const Rgb& sigma_t : {Rgb(2.0f), Rgb(0.5f, 1.5f, 3.0f)}) {
      const Medium medium = make_medium(field.grid, sigma_t);
      const auto delta = make_distance_strategy({.strategy = "delta-local"});
      const auto whole = make_distance_strategy({.strategy = "decomposition"});
      const auto lazy = make_distance_strategy({.strategy = "decomposition"}, {.density = false});
      uint64_t saved = 0;
      for (uint64_t i = 0; i < 2000; ++i) {
        const Flight a = fly(*delta, medium, i), b = fly(*whole, medium, i);
        Flight c = fly(*lazy, medium, i);
        expect_same(a, b);
        EXPECT_EQ(a.lookups, b.lookups);
        EXPECT_TRUE(!c.collided || (c.density > 0.0f && c.density <= a.density));
        saved += a.lookups - c.lookups;
        c.density = a.density;
        expect_same(a, c);
      }
      // The bricks of the coarse fields all reach beyond the grid, where nothing is.
      EXPECT_EQ(saved > 0, std::string(field.name) == "fine") << field.name;
    }
}

TEST(Tracking, BoundsOfBlocksSaveLookUpsAndChangeNoFlight) {
  for (const FlightField& field : flight_fields())
    for (const Rgb& sigma_t : {Rgb(2.0f), Rgb(0.5f, 1.5f, 3.0f)}) {
      const Medium medium = make_medium(field.grid, sigma_t);
      const auto local = make_distance_strategy({.strategy = "delta-local"});
      uint64_t saved = 0;
      for (uint64_t i = 0; i < 2000; ++i) {
        Rng rng(5, rng_stream(RngUse::test, 0), i);
        const Flight looks_up = track_bricks(
            medium, kRay, kReach, NullCollisionFlight(medium, kReach, Rgb(1.0f, 0.5f, 2.0f), rng),
            [](float max) { return max; },
            [](NullCollisionFlight& flight, double t, const DensityStretch& stretch, double majorant) {
              return flight.meet(t, stretch.density(t), majorant);
            });
        const Flight flight = fly(*local, medium, i);
        expect_same(flight, looks_up);
        EXPECT_EQ(looks_up.lookups, looks_up.null_collisions + looks_up.collided);
        saved += looks_up.lookups - flight.lookups;
      }
      // Weights of channels need every density, and cells of a constant or of a checkerboard hold all that their brick
      // does.
      const bool even = std::string(field.name) == "constant" || std::string(field.name) == "checker";
      EXPECT_EQ(saved > 0, medium.grey() && !even) << field.name;
    }
}

TEST(Tracking, ProgressiveMajorantsCutTheDensityUntilTheyHaveGrown) {
  const GridFrame frame = centered_frame(7, 0.125, Interpolation::nearest);
  const auto checker = [&](double most) {
    return make_grid(frame, [=](int x, int y, int z) { return std::min((x + y + z) & 1 ? 1.5 : 0.3, most); });
  };
  for (const Rgb& sigma_t : {Rgb(2.0f), Rgb(0.5f, 1.5f, 3.0f)})
    for (uint64_t pass = 0; pass < 70; pass += pass < 4 ? 1 : 33) {
      const Medium medium = make_medium(checker(1.5), sigma_t);
      const Medium cut = make_medium(checker(std::min(1.5, std::ldexp(0.375, static_cast<int>(pass)))), sigma_t);
      const auto progressive = make_distance_strategy({"progressive-null", {{"majorant", 0.25f}}}, {.pass = pass});
      const auto delta = make_distance_strategy({.strategy = "delta-local"});
      uint64_t violations = 0;
      for (uint64_t i = 0; i < 2000; ++i) {
        const Flight flight = fly(*progressive, medium, i);
        expect_same(flight, fly(*delta, cut, i));
        violations += flight.majorant_violations;
      }
      EXPECT_EQ(violations > 0, pass < 2) << "pass " << pass;
    }
}

TEST(Tracking, WeightedFlightsUnderMajorantsThatBoundAreThoseOfDeltaTracking) {
  for (const FlightField& field : flight_fields())
    for (const Rgb& sigma_t : {Rgb(2.0f), Rgb(0.5f, 1.5f, 3.0f)}) {
      const Medium medium = make_medium(field.grid, sigma_t);
      const auto delta = make_distance_strategy({.strategy = "delta-local"});
      const auto weighted = make_distance_strategy({"weighted", {{"majorant", 1.0f}}});
      for (uint64_t i = 0; i < 2000; ++i) {
        const Flight flight = fly(*weighted, medium, i);
        expect_same(flight, fly(*delta, medium, i));
        EXPECT_EQ(flight.majorant_violations, 0u);
      }
    }
}

TEST(Tracking, BeyondMajorantsWeightsAreOfEitherSign) {
  // Dense voxels have four times the majorant: each look-up there multiplies by 4 + |1 - 4| or, where it is null, by
  // minus that. In the others the majorant bounds.
  const GridFrame frame = centered_frame(7, 0.125, Interpolation::nearest);
  const Medium medium =
      make_medium(make_grid(frame, [](int x, int y, int z) { return (x + y + z) & 1 ? 1.5 : 0.3; }), Rgb(2.0f));
  const auto weighted = make_distance_strategy({"weighted", {{"majorant", 0.25f}}});
  int negative = 0;
  for (uint64_t i = 0; i < 2000; ++i) {
    const Flight flight = fly(*weighted, medium, i);
    const double growth = std::pow(7.0, flight.majorant_violations);
    EXPECT_NEAR(std::abs(flight.weight.r), growth, 1e-5 * growth);
    EXPECT_TRUE(flight.weight.r > 0.0f || flight.majorant_violations > 0);
    EXPECT_TRUE(is_grey(flight.weight));
    negative += flight.weight.r < 0.0f;
  }
  EXPECT_GT(negative, 200);
}

TEST(Tracking, TheSumOverChannelsStaysAsItWas) {
  const Rgb power(1.0f, 0.5f, 2.0f);
  for (const FlightField& field : flight_fields())
    for (const Rgb& sigma_t : {Rgb(0.5f, 1.5f, 3.0f), Rgb(0.0f, 8.0f, 2.0f), Rgb(0.0f, 0.0f, 5.0f)})
      for (const char* name : {"delta", "delta-local", "progressive-null", "decomposition"}) {
        const auto strategy = make_distance_strategy({.strategy = name});
        for (uint64_t i = 0; i < 500; ++i) {
          const Flight flight = fly(*strategy, make_medium(field.grid, sigma_t), i);
          EXPECT_NEAR(glm::dot(flight.weight, power), 3.5, 1e-5) << name << " on " << field.name;
          EXPECT_TRUE(flight.weight.r >= 0.0f && flight.weight.g >= 0.0f && flight.weight.b >= 0.0f);
        }
      }
}

TEST(Tracking, EmptyBricksCostNothing) {
  GridFrame frame;
  frame.lo = Vec3i(0);
  frame.hi = Vec3i(160, 8, 8);
  frame.index_to_world = glm::scale(Mat4d(1.0), Vec3d(0.0625));
  const auto grid = make_grid(frame, [](int x, int, int) { return x > 80 && x < 86 ? 3.0 : 0.0; });
  const Medium medium = make_medium(grid, Rgb(0.5f));
  const Ray ray{Vec3(-1.0f, 0.3f, 0.3f), Vec3(1, 0, 0)};
  for (const char* name : {"delta-local", "progressive-null", "decomposition", "ray-march-adaptive"}) {
    const auto strategy = make_distance_strategy({.strategy = name});
    for (uint64_t i = 0; i < 1000; ++i) {
      Rng rng(5, rng_stream(RngUse::test, 1), i);
      EXPECT_LE(strategy->sample(medium, ray, {}, Rgb(1.0f), rng).lookups, 12u) << name;
      EXPECT_EQ(strategy->sample(medium, ray, {0.0f, 5.9f}, Rgb(1.0f), rng).lookups, 0u) << name;
    }
  }
}

TEST(Tracking, NothingIsNullWithoutAGrid) {
  const auto local = make_distance_strategy({.strategy = "delta-local"}),
             exact = make_distance_strategy({.strategy = "homogeneous"});
  for (const Rgb& sigma_t : {Rgb(0.5f), Rgb(0.1f, 0.5f, 2.0f)}) {
    const Medium medium = make_medium(nullptr, sigma_t);
    for (uint64_t i = 0; i < 1000; ++i) {
      const Flight flight = fly(*local, medium, i);
      expect_same(flight, fly(*exact, medium, i));
      EXPECT_TRUE(std::isfinite(flight.integral));
    }
  }
}

TEST(Tracking, AdaptiveMarchesTakeStepsOfAnOpticalThickness) {
  // One brick that varies along the ray, of largest density 2, 8 voxels of 1/4 m long, between empty ones.
  GridFrame frame;
  frame.lo = Vec3i(0, -9, -9);
  frame.hi = Vec3i(8, 9, 9);
  frame.index_to_world = glm::scale(Mat4d(1.0), Vec3d(0.25));
  const auto grid = make_grid(frame, [](int x, int, int) { return x == 0 || x == 8 ? 0.0 : x == 4 ? 2.0 : 1.0; });
  const Ray ray{Vec3(-1.0f, 0.1f, 0.1f), Vec3(1, 0, 0)};
  const auto march = [&](float step, float optical_step, float sigma_t) {
    Rng rng(5, rng_stream(RngUse::test, 2), 0);
    return make_distance_strategy({"ray-march-adaptive", {{"step", step}, {"optical_step", optical_step}}})
        ->sample(make_medium(grid, Rgb(sigma_t)), ray, {}, Rgb(1.0f), rng);
  };
  EXPECT_EQ(march(1.0f, 0.1f, 1e-6f).lookups, 8u);          // each a voxel
  EXPECT_EQ(march(4.0f, 0.1f, 1e-6f).lookups, 2u);          // each four voxels
  EXPECT_EQ(march(4.0f, 0x1p-20f, 0x1p-18f).lookups, 16u);  // 2^-20 / (2^-18 * 2) = 1/8 m
  const Flight dense = march(4.0f, 0.1f, 2e4f);  // a sixteenth of four voxels; its middle lies at an eighth of one
  EXPECT_EQ(dense.lookups, 1u);
  EXPECT_TRUE(dense.collided);
  EXPECT_FLOAT_EQ(dense.density, 0.125f);
}

}  // namespace
}  // namespace vpm
