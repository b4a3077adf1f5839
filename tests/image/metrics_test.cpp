// The error measures against values worked out by hand.
#include "vpm/image/metrics.h"

#include <gtest/gtest.h>

#include <limits>

#include "vpm/base/error.h"

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

}  // namespace
}  // namespace vpm
