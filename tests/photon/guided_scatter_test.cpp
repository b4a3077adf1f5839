// Directions on a grid: what tracks tell of them, draws against their densities, and scattering by them, one event at a
// time.
#include "vpm/photon/guide/guided_scatter.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/statistics.h"
#include "vpm/base/warp.h"
#include "vpm/medium/grid/make_grid.h"

namespace vpm {
namespace {

const Box kBox{Vec3(-1.0f), Vec3(1.0f)};
const float kOneCell = static_cast<float>(DirectionCells::kCount) / (4.0f * kPi);  // 1/sr, of a single cell

TEST(DirectionGuide, SendsLightAgainstTheTracks) {
  const Vec3 travel = glm::normalize(Vec3(0.3f, -0.5f, 0.4f));
  DirectionGuide guide(kBox, 4);
  guide.add_track({Vec3(-0.9f, 0.9f, -0.9f), travel}, 0.1f, 2.0f);
  guide.finish();
  const DirectionDensity known = guide.at(Vec3(-0.9f, 0.9f, -0.9f));
  ASSERT_TRUE(known);
  EXPECT_EQ(known.pdf(-travel), kOneCell);
  EXPECT_EQ(known.pdf(travel), 0.0f);
  Rng rng(1, rng_stream(RngUse::test, 0), 0);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(known.pdf(known.sample(rng)), kOneCell);
}

TEST(DirectionGuide, TellsNeighboursAndNobodyElse) {
  DirectionGuide guide(kBox, 4);
  guide.add_track({Vec3(-0.9f, -0.9f, -0.9f), Vec3(0.0f, 0.0f, -1.0f)}, 0.05f, 1.0f);
  guide.finish();
  EXPECT_TRUE(guide.at(Vec3(-0.3f, -0.3f, -0.3f)));
  EXPECT_FALSE(guide.at(Vec3(0.3f, -0.9f, -0.9f)));
  EXPECT_FALSE(guide.at(Vec3(0.9f)));
}

/// Each track counts by its weight and its length, and the sum of two guides is that of all tracks.
TEST(DirectionGuide, WeighsTracksByWhatFlowsThere) {
  const Vec3 center(0.0f), x(1.0f, 0.0f, 0.0f), z(0.0f, 0.0f, 1.0f);
  DirectionGuide guide(kBox, 1), other(kBox, 1);
  guide.add_track({center, x}, 0.2f, 3.0f);
  other.add_track({center, z}, 0.5f, 0.4f);
  guide.merge(other);
  guide.finish();
  EXPECT_FLOAT_EQ(guide.at(center).pdf(-x), 0.75f * kOneCell);
  EXPECT_FLOAT_EQ(guide.at(center).pdf(-z), 0.25f * kOneCell);
}

/// In bins that are quarters of cells.
TEST(DirectionGuide, DrawsWhatItsDensitySays) {
  Rng rng(1, rng_stream(RngUse::test, 1), 0);
  DirectionGuide guide(kBox, 2);
  for (int i = 0; i < 400; ++i) {
    const Vec3 origin = 2.0f * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.0f;
    guide.add_track({origin, uniform_sphere(rng.uniform2())}, kInfinity, std::pow(rng.uniform(), 8.0f));
  }
  guide.finish();
  constexpr int kRows = 2 * DirectionCells::kRows, kColumns = 2 * DirectionCells::kColumns, kDraws = 300'000;
  const Vec2 bins(kRows, kColumns);
  for (const Vec3& place : {Vec3(-0.5f), Vec3(0.5f, -0.5f, 0.5f)}) {
    const DirectionDensity known = guide.at(place);
    std::vector<double> counts(size_t{kRows} * kColumns, 0.0), probabilities;
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column) {
        const Vec3 middle = uniform_sphere((Vec2(row, column) + 0.5f) / bins);
        probabilities.push_back(known.pdf(middle) * 4.0 * kPiD / (kRows * kColumns));
      }
    double sum = 0.0;
    for (const double p : probabilities) sum += p;
    EXPECT_NEAR(sum, 1.0, 1e-5);
    for (int i = 0; i < kDraws; ++i) {
      const Vec2 u = uniform_sphere_numbers(known.sample(rng)) * bins;
      const int row = std::min(static_cast<int>(u.x), kRows - 1),
                column = std::min(static_cast<int>(u.y), kColumns - 1);
      counts[static_cast<size_t>(row * kColumns + column)] += 1.0;
    }
    expect_distribution(counts, probabilities, kFalseAlarms);
  }
}

/// The guide asks for directions into the floor, which stand for their mirror images, and for others.
TEST(GuidedScatter, KeepsThePowerAtSurfacesInTheMean) {
  Scene scene;
  add_shape(scene, quad_mesh(Vec3d(-1.0, 0.0, 1.0), Vec3d(2.0, 0.0, 0.0), Vec3d(0.0, 0.0, -2.0)),
            Lambertian{Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  DirectionGuide guide({Vec3(-1.0f), Vec3(1.0f)}, 1);
  guide.add_track({Vec3(0.0f), glm::normalize(Vec3(0.2f, 1.0f, 0.1f))}, 1.0f, 2.0f);
  guide.add_track({Vec3(0.0f), glm::normalize(Vec3(0.5f, -1.0f, 0.3f))}, 1.0f, 1.0f);
  guide.finish();
  const Ray down{Vec3(0.0f, 1.0f, 0.0f), Vec3(0.0f, -1.0f, 0.0f)};
  MediumId medium = kVacuum;
  WalkCounters counters;
  const Encounter met = meet(scene, down, kInfinity, medium, counters);
  ASSERT_TRUE(met);
  Moments powers;
  for (uint64_t i = 0; i < 100'000; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 51), i);
    PathState state{down, kVacuum, Rgb(1.0f)};
    Scatter scatter;
    powers.add(scatter_at_surface(guide, scene, met.hits[0], state, rng, scatter) ? state.throughput.g : 0.0);
    EXPECT_GT(scatter.direction.y, 0.0f);
    EXPECT_LE(state.throughput.g, 1.12f);
  }
  expect_mean(powers, 1.0, 1e-6);
}

/// However wrong the guide.
TEST(GuidedScatter, MakesNoPhotonMuchHeavier) {
  DirectionGuide guide({Vec3(-1.0f), Vec3(1.0f)}, 1);
  guide.add_track({Vec3(0.0f), Vec3(0.0f, 0.0f, 1.0f)}, 1.0f, 1.0f);
  guide.finish();
  const Medium fog = make_medium(nullptr, Rgb(1.0f), 1.0f);
  Moments powers;
  for (uint64_t i = 0; i < 100'000; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 50), i);
    PathState state{{Vec3(0.0f), Vec3(1.0f, 0.0f, 0.0f)}, 0, Rgb(1.0f)};
    ASSERT_TRUE(scatter_in_medium(guide, fog.properties(state.ray.origin), state, rng));
    EXPECT_LE(state.throughput.g, 1.12f);
    powers.add(state.throughput.g);
  }
  expect_mean(powers, 1.0, 1e-6);
}

}  // namespace
}  // namespace vpm
