// What of the difference of two pictures is noise.
#include "vpm/image/noisy_difference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vpm/base/rng.h"
#include "vpm/base/statistics.h"
#include "vpm/image/metrics.h"

namespace vpm {
namespace {

constexpr int kSide = 32;

double noise(Rng& rng) { return std::sqrt(12.0) * (rng.uniform_double() - 0.5); }

Image filled(int width, int height, float value) {
  Image image(width, height);
  for (Rgb& pixel : image.pixels) pixel = Rgb(value);
  return image;
}

/// A picture of `value`, whose noise of standard deviation `sigma` squares of `edge` pixels share.
NoisyImage picture_of(float value, double sigma, int edge, uint64_t seed) {
  NoisyImage picture{filled(kSide, kSide, value), filled(kSide, kSide, static_cast<float>(sigma * sigma)),
                     Rgbd(sigma * sigma * edge * edge / (kSide * kSide))};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      Rng rng(seed, static_cast<uint64_t>(y / edge), static_cast<uint64_t>(x / edge));
      for (int c = 0; c < 3; ++c) picture.image.at(x, y)[c] += static_cast<float>(sigma * noise(rng));
    }
  return picture;
}

/// False alarms: 4.5 standard errors of the mean of 200, 1 in 150,000 for each. The stated standard errors are to be
/// those of the estimates within a quarter: they are estimates from a few squares themselves.
TEST(NoisyDifference, IsTheErrorLessBothPicturesNoise) {
  for (const int edge : {1, 4}) {
    Moments found, stated, means, of_means;
    for (uint64_t seed = 0; seed < 200; ++seed) {
      const NoisyImage picture = picture_of(1.02f, 0.1, edge, 2 * seed);
      const NoisyImage reference = picture_of(1.0f, 0.05, 1, 2 * seed + 1);
      const NoisyDifference difference = noisy_difference(picture, reference);
      EXPECT_NEAR(difference.noise, 0.01 / 1.01, 3e-4);
      EXPECT_NEAR(difference.noise_of_reference, 0.0025 / 1.01, 1e-4);
      EXPECT_TRUE(difference.means_know_correlation);
      found.add(difference.less_noise);
      stated.add(difference.standard_error);
      means.add(difference.of_channel_means.g);
      of_means.add(difference.standard_errors.g);
    }
    // The scale's own noise changes some percent of what it divides.
    EXPECT_NEAR(found.mean(), 0.0004 / 1.01, 4.5 * std::sqrt(found.variance_of_mean()) + 2e-4) << edge;
    EXPECT_NEAR(stated.mean() / std::sqrt(found.variance()), 1.1, 0.25) << edge;
    EXPECT_NEAR(means.mean(), 0.02, 4.5 * std::sqrt(means.variance_of_mean())) << edge;
    EXPECT_NEAR(of_means.mean() / std::sqrt(means.variance()), 1.0, 0.2) << edge;
  }
}

TEST(NoisyDifference, WithoutVariancesNothingIsNoise) {
  const NoisyImage a{filled(3, 2, 1.5f), {}, {}}, b{filled(3, 2, 1.0f), {}, {}};
  const NoisyDifference difference = noisy_difference(a, b);
  EXPECT_EQ(difference.less_noise, relative_mse(a.image, b.image));
  EXPECT_EQ(difference.noise, 0.0);
  EXPECT_EQ(difference.standard_errors, Rgbd(0.0));
  EXPECT_FALSE(difference.means_know_correlation);
}

TEST(NoisyDifference, ResamplingKeepsMeansAndAveragesNoise) {
  const NoisyImage fine = picture_of(1.0f, 0.3, 1, 7);
  for (const auto& [width, height] : {std::pair(8, 16), std::pair(12, 7), std::pair(50, 33)}) {
    const NoisyImage coarse = resampled(fine, width, height);
    EXPECT_NEAR(channel_means(coarse.image).g, channel_means(fine.image).g, 1e-6);
    EXPECT_EQ(coarse.image.width, width);
    EXPECT_EQ(coarse.image.height, height);
  }
  const NoisyImage quarter = resampled(fine, kSide / 2, kSide / 2);
  EXPECT_FLOAT_EQ(quarter.image.at(0, 0).g, 0.25f * (fine.image.at(0, 0).g + fine.image.at(1, 0).g +
                                                     fine.image.at(0, 1).g + fine.image.at(1, 1).g));
  EXPECT_FLOAT_EQ(quarter.variance->at(3, 5).r, 0.25f * fine.variance->at(0, 0).r);
}

}  // namespace
}  // namespace vpm
