// Numbers that say how far one picture is from another: the sums.
#include "vpm/image/metrics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "vpm/base/error.h"
#include "vpm/base/statistics.h"

namespace vpm {
namespace {

void check_sizes(const Image& image, const Image& reference) {
  if (image.width == reference.width && image.height == reference.height) return;
  throw InputError("the pictures differ in size: " + std::to_string(image.width) + " x " +
                   std::to_string(image.height) + " and " + std::to_string(reference.width) + " x " +
                   std::to_string(reference.height) + " pixels; compare pictures of one size");
}

/// The mean over pixels and channels of error(channel, value, reference value).
template <typename Error>
double mean_error(const Image& image, const Image& reference, const Error& error) {
  check_sizes(image, reference);
  assert(!image.pixels.empty());
  Sum sum;
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) sum.add(error(c, double{image.pixels[i][c]}, double{reference.pixels[i][c]}));
  }
  return sum.value() / (3.0 * static_cast<double>(image.pixels.size()));
}

/// One channel's term of the relative MSE, for that mean of the reference over the channel.
double relative_square(double value, double truth, double mean) {
  const double difference = value - truth;
  return difference == 0.0 ? 0.0 : difference * difference / relative_scale(truth, mean);
}

}  // namespace

Rgbd channel_means(const Image& image) {
  assert(!image.pixels.empty());
  Sum sums[3];
  for (const Rgb& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) sums[c].add(pixel[c]);
  }
  return Rgbd(sums[0].value(), sums[1].value(), sums[2].value()) / static_cast<double>(image.pixels.size());
}

double mse(const Image& image, const Image& reference) {
  return mean_error(image, reference, [](int, double value, double truth) {
    const double difference = value - truth;
    return difference * difference;
  });
}

double relative_mse(const Image& image, const Image& reference) {
  const Rgbd means = channel_means(reference);
  return mean_error(image, reference,
                    [&](int c, double value, double truth) { return relative_square(value, truth, means[c]); });
}

double relative_variance(const Image& variance, const Image& mean) {
  const Rgbd means = channel_means(mean);
  return mean_error(variance, mean, [&](int c, double square, double value) {
    return square == 0.0 ? 0.0 : square / relative_scale(value, means[c]);
  });
}

double relative_mse_of_pbrt(const Image& image, const Image& reference) {
  return mean_error(image, reference, [](int, double value, double truth) {
    const double difference = value - truth;
    return difference == 0.0 ? 0.0 : difference * difference / scale_of_pbrt(truth);
  });
}

std::vector<PixelError> worst_pixels(const Image& image, const Image& reference, size_t count) {
  check_sizes(image, reference);
  const Rgbd means = channel_means(reference);
  std::vector<PixelError> all(image.pixels.size());
  for (size_t i = 0; i < all.size(); ++i) {
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) sum += relative_square(image.pixels[i][c], reference.pixels[i][c], means[c]);
    const auto width = static_cast<size_t>(image.width);
    all[i] = {static_cast<int>(i % width), static_cast<int>(i / width), sum / 3.0};
  }
  const auto worse = [](const PixelError& a, const PixelError& b) {
    const bool a_broken = std::isnan(a.error), b_broken = std::isnan(b.error);
    if (a_broken || b_broken || a.error == b.error)
      return a_broken != b_broken ? a_broken : std::pair(a.y, a.x) < std::pair(b.y, b.x);
    return a.error > b.error;
  };
  count = std::min(count, all.size());
  std::partial_sort(all.begin(), all.begin() + static_cast<ptrdiff_t>(count), all.end(), worse);
  all.resize(count);
  return all;
}

size_t non_finite_pixels(const Image& image) {
  return static_cast<size_t>(
      std::count_if(image.pixels.begin(), image.pixels.end(), [](const Rgb& pixel) { return !is_finite(pixel); }));
}

}  // namespace vpm
