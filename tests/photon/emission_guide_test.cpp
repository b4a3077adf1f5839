// The learned density of emission: that it is one, that it finds what scores, and that weights undo it.
#include "vpm/photon/emission_guide.h"

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace vpm {
namespace {

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
