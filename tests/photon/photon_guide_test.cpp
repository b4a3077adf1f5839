// Importance on a grid: lengths of tracks, where it rises, and what importons make of a room. The learned density of
// emission: that it is one, that it finds what scores, and that weights undo it.
#include "vpm/photon/guide/photon_guide.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/statistics.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/photon/guide/emission_guide.h"

namespace vpm {
namespace {

const Box kImportanceBox{Vec3(-1.0f, -2.0f, 0.0f),
                         Vec3(3.0f, 0.0f, 1.0f)};  // 4 x 2 x 1 m: cubes of 1/2 m are 8 x 4 x 2

Vec3 center(int x, int y, int z) { return kImportanceBox.lo + 0.5f * (Vec3(x, y, z) + 0.5f); }

TEST(ImportanceMap, TracksLeaveTheirLengthInEachCube) {
  ImportanceMap map(kImportanceBox, 8);
  map.add_track({center(1, 2, 0), Vec3(1.0f, 0.0f, 0.0f)}, 1.0f, 3.0f);
  EXPECT_FLOAT_EQ(map.at(center(1, 2, 0)), 3.0f * 0.5f);  // a quarter of a metre of half a metre
  EXPECT_FLOAT_EQ(map.at(center(2, 2, 0)), 3.0f);
  EXPECT_FLOAT_EQ(map.at(center(3, 2, 0)), 3.0f * 0.5f);
  EXPECT_EQ(map.at(center(4, 2, 0)), 0.0f);
  EXPECT_EQ(map.at(center(2, 1, 0)), 0.0f);
}

TEST(ImportanceMap, SlantedTracksLeaveAllTheirLengthInside) {
  ImportanceMap map(kImportanceBox, 8);
  const Vec3 from(-3.0f, -2.5f, 0.3f), to(4.0f, 1.0f, 0.6f);  // in by x at -1, out by y at 0
  map.add_track({from, glm::normalize(to - from)}, glm::distance(from, to), 1.0f);
  double sum = 0.0;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 2; ++z) sum += map.at(center(x, y, z)) * 0.5;
  const float share = 2.5f / 3.5f - 2.0f / 7.0f;  // between y = 0 and x = -1
  EXPECT_NEAR(sum, share * glm::distance(from, to), 1e-5);
}

TEST(ImportanceMap, TellsWhereImportanceRises) {
  ImportanceMap map(kImportanceBox, 8);
  map.add_track({center(5, 1, 1), Vec3(0.0f, 1.0f, 0.0f)}, 0.1f, 10.0f);  // 2 in that cube alone
  const Ray along{center(1, 1, 1), Vec3(1.0f, 0.0f, 0.0f)};
  const float rise = map.first_above(along, 1.0f);
  EXPECT_NEAR(rise, 1.75f, 1e-3f);
  EXPECT_GT(map.at(along.at(rise)), 1.0f);
  EXPECT_EQ(map.first_above(along, 3.0f), kInfinity);
  EXPECT_EQ(map.first_above({center(5, 1, 1), Vec3(1.0f, 0.0f, 0.0f)}, 1.0f), kInfinity);  // from there it falls
  EXPECT_EQ(map.first_above({center(1, 2, 1), Vec3(1.0f, 0.0f, 0.0f)}, 1.0f), kInfinity);  // passes by
}

TEST(ImportanceMap, IsPositiveEverywhereOnceFinished) {
  ImportanceMap map(kImportanceBox, 8);
  map.add_track({center(5, 1, 1), Vec3(0.0f, 1.0f, 0.0f)}, 0.1f, 10.0f);
  map.finish();
  EXPECT_GT(map.at(center(0, 0, 0)), 0.0f);
  EXPECT_GT(map.at(center(5, 1, 1)), map.at(center(6, 1, 1)));
  EXPECT_GT(map.at(center(6, 1, 1)), 100.0f * map.at(center(0, 0, 0)));
  ImportanceMap dark(kImportanceBox, 8);
  dark.finish();
  EXPECT_GT(dark.at(center(0, 0, 0)), 0.0f);
}

/// In a purely absorbing fog importons fly straight on: what the camera sees at a distance is worth exp(-distance) as
/// much, and what is behind it nothing but the least.
TEST(ImportanceMap, ImportonsFadeAsLightDoes) {
  Medium fog;
  fog.sigma_t = Rgb(1.0f);
  Scene scene = boxed_medium(fog, PointLight{Vec3(0.0f, 0.9f, 0.0f), Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.0f, 0.0f, 0.95f), Vec3(0.0f), Vec3(0, 1, 0), 2.0f, {8, 8});
  scene.camera_medium = medium_at(scene, scene.camera.position);
  const auto strategy = make_distance_strategy({});
  const ImportanceMap map = trace_importons(scene, *strategy, {.importons = 20'000}, 1, 0, 100).map;
  // The beam stays within the cubes about the axis.
  const double fade = map.at(Vec3(0.01f, 0.01f, -0.5f)) / map.at(Vec3(0.01f, 0.01f, 0.5f));
  EXPECT_NEAR(fade, std::exp(-1.0), 0.03);  // 7400 importons of 20,000 are left: their share is off by 0.0034 / 0.37
  EXPECT_GT(map.at(Vec3(0.01f, 0.01f, 0.5f)), 1e3f * map.at(Vec3(0.8f, 0.8f, 0.5f)));
}

constexpr uint64_t kScouts = 40'000, kStream = 77;

/// Scores in a small box of three of the dimensions: 0.1 x 0.1 x 0.2 of them.
float in_corner(const EmissionPoint& p, Rng&) {
  return p.numbers.direction.x > 0.9f && p.numbers.direction.y < 0.1f && p.numbers.choice > 0.8 ? 2.0f : 0.0f;
}
/// Smooth, in another two.
float smooth(const EmissionPoint& p, Rng&) { return p.numbers.place.x * p.numbers.place.x + 0.3f * p.numbers.place.y; }

TEST(EmissionGuide, IsUniformBeforeItLearns) {
  Rng rng(1, 2, 3);
  const EmissionGuide guide;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(guide.sample(rng).density, 1.0f);
}

/// The mean of 1 / density is the volume of the cube, and f / density has the mean that f has over it.
TEST(EmissionGuide, WeightsUndoTheDensity) {
  for (const auto& score : {EmissionGuide::Score(in_corner), EmissionGuide::Score(smooth)}) {
    const EmissionGuide guide = EmissionGuide::learn(kScouts, 5, kStream, score);
    Moments volume, first, product;
    Rng rng(1, 2, 3);
    for (int i = 0; i < 200'000; ++i) {
      const EmissionGuide::Sample s = guide.sample(rng);
      volume.add(1.0 / s.density);
      first.add(s.point.light / s.density);
      product.add(s.point.numbers.direction.x * s.point.numbers.place.y / s.density);
    }
    expect_mean(volume, 1.0, kFalseAlarms, "volume");
    expect_mean(first, 0.5, kFalseAlarms, "the light's number");
    expect_mean(product, 0.25, kFalseAlarms, "a product");
  }
}

TEST(EmissionGuide, FindsTheCornerThatScores) {
  const EmissionGuide guide = EmissionGuide::learn(kScouts, 5, kStream, in_corner);
  EXPECT_NEAR(guide.mean_score(), 0.004, 0.0004);  // 20 of 10,000 scouts of the first round find it, thousands later
  Rng rng(1, 2, 3);
  int found = 0;
  for (int i = 0; i < 10'000; ++i) found += in_corner(guide.sample(rng).point, rng) > 0.0f;
  EXPECT_GT(found, 2'000);  // a hundred times as many as without it
}

/// A sum of scores has less variance than over uniform points, and no weight is above ten.
TEST(EmissionGuide, LowersTheVarianceOfSums) {
  const EmissionGuide guide = EmissionGuide::learn(kScouts, 5, kStream, smooth);
  Moments guided, uniform;
  float least = 1.0f;
  Rng rng(1, 2, 3);
  for (int i = 0; i < 100'000; ++i) {
    const EmissionGuide::Sample s = guide.sample(rng);
    least = std::min(least, s.density);
    guided.add(smooth(s.point, rng) / s.density);
    uniform.add(smooth(EmissionGuide().sample(rng).point, rng));
  }
  expect_mean(guided, 1.0 / 3.0 + 0.15, kFalseAlarms);
  EXPECT_LT(guided.variance(), 0.25 * uniform.variance());
  EXPECT_GE(least, 0.1f);
}

TEST(EmissionGuide, WhatNeverScoresLeavesItUniform) {
  const EmissionGuide guide = EmissionGuide::learn(1000, 5, kStream, [](const EmissionPoint&, Rng&) { return 0.0f; });
  Rng rng(1, 2, 3);
  EXPECT_EQ(guide.sample(rng).density, 1.0f);
  EXPECT_EQ(guide.mean_score(), 0.0);
}

}  // namespace
}  // namespace vpm
