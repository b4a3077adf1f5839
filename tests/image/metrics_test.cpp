// The error measures against values worked out by hand, and what of the difference of two pictures is noise.
#include "vpm/image/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "vpm/base/error.h"
#include "vpm/base/rng.h"
#include "vpm/base/statistics/moments.h"

namespace vpm {
namespace {

/// A picture of one row.
Image row(const std::vector<Rgb>& pixels) {
  Image image(static_cast<int>(pixels.size()), 1);
  image.pixels = pixels;
  return image;
}

TEST(Metrics, Luminance) {
  EXPECT_FLOAT_EQ(luminance(Rgb(1.0f)), 1.0f);
  EXPECT_FLOAT_EQ(luminance(Rgb(1.0f, 0.0f, 0.0f)), 0.2126f);
  EXPECT_FLOAT_EQ(luminance(Rgb(0.0f, 1.0f, 0.0f)), 0.7152f);
  EXPECT_FLOAT_EQ(luminance(Rgb(0.0f, 0.0f, 1.0f)), 0.0722f);
}

TEST(Metrics, ChannelMeans) {
  const Rgbd means = channel_means(row({{1, 2, 3}, {3, 2, -1}}));
  EXPECT_EQ(means, Rgbd(2.0, 2.0, 1.0));
}

TEST(Metrics, MeanSquaredError) {
  const Image reference = row({{1, 2, 3}, {4, 5, 6}});
  EXPECT_EQ(mse(reference, reference), 0.0);
  EXPECT_DOUBLE_EQ(mse(row({{2, 2, 3}, {4, 5, 3}}), reference), (1.0 + 9.0) / 6.0);
}

TEST(Metrics, RelativeError) {
  const Image reference = row({{1, 2, 0}, {3, 2, 10}});
  const Image image = row({{2, 2, 1}, {3, 1, 10}});
  // red: mean 2, 1 / (1 + 0.04); green: mean 2, 1 / (4 + 0.04); blue: mean 5, 1 / (0 + 0.25)
  EXPECT_DOUBLE_EQ(relative_mse(image, reference), (1.0 / 1.04 + 1.0 / 4.04 + 4.0) / 6.0);
  EXPECT_EQ(relative_mse(reference, reference), 0.0);
}

TEST(Metrics, RelativeVariance) {
  const Image picture = row({{1, 2, 0}, {3, 2, 10}});
  EXPECT_DOUBLE_EQ(relative_variance(row({{1, 0, 1}, {0, 1, 0}}), picture), (1.0 / 1.04 + 1.0 / 4.04 + 4.0) / 6.0);
  EXPECT_EQ(relative_variance(Image(2, 1), Image(2, 1)), 0.0);
}

TEST(Metrics, RelativeErrorDoesNotDependOnTheUnit) {
  const double error = relative_mse(row({{2, 2, 1}, {3, 1, 10}}), row({{1, 2, 0}, {3, 2, 10}}));
  EXPECT_DOUBLE_EQ(relative_mse(row({{8, 8, 4}, {12, 4, 40}}), row({{4, 8, 0}, {12, 8, 40}})), error);
}

TEST(Metrics, BlackChannel) {
  const Image red = row({{1, 0, 0}, {1, 0, 0}});
  EXPECT_DOUBLE_EQ(relative_mse(row({{2, 0, 0}, {1, 0, 0}}), red), 1.0 / 1.01 / 6.0);
  EXPECT_TRUE(std::isinf(relative_mse(row({{1, 0, 1}, {1, 0, 0}}), red)));
}

TEST(Metrics, RelativeErrorOfPbrt) {
  const Image reference = row({{1, 2, 0}, {3, 2, 10}});
  const Image image = row({{2, 2, 1}, {3, 1, 10}});
  const double sum = 1.0 / (1.01 * 1.01) + 1.0 / (2.01 * 2.01) + 1.0 / (0.01 * 0.01);
  EXPECT_DOUBLE_EQ(relative_mse_of_pbrt(image, reference), sum / 6.0);
  EXPECT_EQ(relative_mse_of_pbrt(reference, reference), 0.0);
}

TEST(Metrics, WorstPixelsAreSortedByTheirPartInTheRelativeError) {
  Image reference(2, 2), image(2, 2);
  reference.pixels = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  image.pixels = {{1, 1, 2}, {1, 1, 1}, {4, 1, 1}, {1, 3, 1}};
  const std::vector<PixelError> worst = worst_pixels(image, reference, 3);
  ASSERT_EQ(worst.size(), 3u);
  const double errors[] = {9.0 / 1.01 / 3.0, 4.0 / 1.01 / 3.0, 1.0 / 1.01 / 3.0};
  const int columns[] = {0, 1, 0}, rows[] = {1, 1, 0};
  double sum = 0.0;
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(worst[i].x, columns[i]);
    EXPECT_EQ(worst[i].y, rows[i]);
    EXPECT_DOUBLE_EQ(worst[i].error, errors[i]);
    sum += worst[i].error;
  }
  EXPECT_DOUBLE_EQ(relative_mse(image, reference), sum / 4.0);
  EXPECT_EQ(worst_pixels(image, reference, 9).size(), 4u);
  image.pixels[1].g = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(worst_pixels(image, reference, 1)[0].error));
  EXPECT_EQ(non_finite_pixels(image), 1u);
  EXPECT_EQ(non_finite_pixels(reference), 0u);
}

TEST(Metrics, NonFinitePixelsShow) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Image good = row({{1, 1, 1}}), bad = row({{1, nan, 1}});
  EXPECT_TRUE(std::isnan(mse(bad, good)));
  EXPECT_TRUE(std::isnan(relative_mse(bad, good)));
  EXPECT_TRUE(std::isnan(relative_mse(good, bad)));
}

TEST(Metrics, RefuseDifferentSizes) {
  EXPECT_THROW(mse(Image(2, 3), Image(3, 2)), InputError);
  EXPECT_THROW(relative_mse(Image(2, 3), Image(3, 2)), InputError);
  EXPECT_THROW(relative_mse_of_pbrt(Image(2, 3), Image(3, 2)), InputError);
  EXPECT_THROW(worst_pixels(Image(2, 3), Image(3, 2), 1), InputError);
}

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
