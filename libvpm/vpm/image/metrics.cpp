// How far one picture is from another: sums over pixels, and over squares of pixels.
#include "vpm/image/metrics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/base/statistics/moments.h"

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
    cancellation_point();
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

namespace {

/// What pixels of one row or column take from those of another number: an interval of the old ones for each new one.
struct Cover {
  int first;
  std::vector<double> shares;  // of `first` and those that follow, in the new pixel; they sum to 1
};

std::vector<Cover> covers(int from, int to) {
  std::vector<Cover> all;
  const double size = static_cast<double>(from) / to;  // old pixels in a new one
  for (int i = 0; i < to; ++i) {
    const double begin = i * size, end = (i + 1) * size;
    Cover cover{std::min(from - 1, static_cast<int>(begin)), {}};
    for (int j = cover.first; j < from && (j < end || cover.shares.empty()); ++j)
      cover.shares.push_back(std::max(0.0, std::min(end, j + 1.0) - std::max(begin, double(j))) / size);
    all.push_back(std::move(cover));
  }
  return all;
}

/// Sums of pixels times their shares, to the power `power`: 1 for means, 2 for their variances.
Image weighted(const Image& image, int width, int height, int power) {
  const std::vector<Cover> columns = covers(image.width, width), rows = covers(image.height, height);
  Image result(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      cancellation_point();
      Rgbd sum(0.0);
      for (size_t v = 0; v < rows[y].shares.size(); ++v)
        for (size_t u = 0; u < columns[x].shares.size(); ++u)
          sum += std::pow(rows[y].shares[v] * columns[x].shares[u], power) *
                 Rgbd(image.at(columns[x].first + static_cast<int>(u), rows[y].first + static_cast<int>(v)));
      result.at(x, y) = Rgb(sum);
    }
  return result;
}

/// The standard error of the mean of values of pixels, from means over squares of so many pixels along an edge.
double standard_error_by_squares(const std::vector<double>& values, int width, int edge) {
  const int height = static_cast<int>(values.size()) / width;
  Moments squares;
  for (int y = 0; y + edge <= height; y += edge)
    for (int x = 0; x + edge <= width; x += edge) {
      cancellation_point();
      Sum sum;
      for (int v = y; v < y + edge; ++v)
        for (int u = x; u < x + edge; ++u) sum.add(values[static_cast<size_t>(v) * width + u]);
      squares.add(sum.value() / (static_cast<double>(edge) * edge));
    }
  return squares.count() < 2 ? 0.0 : std::sqrt(squares.variance_of_mean());
}

double standard_error_of_mean(const std::vector<double>& values, int width) {
  constexpr int kLeastSquares = 4;  // along an edge of the picture: fewer say too little
  const int height = static_cast<int>(values.size()) / width;
  double largest = standard_error_by_squares(values, width, 1);
  for (int edge = 2; edge * kLeastSquares <= std::min(width, height); edge *= 2)
    largest = std::max(largest, standard_error_by_squares(values, width, edge));
  return largest;
}

/// The mean over channels of squares over what those of the relative MSE are divided by.
double relative(const Rgbd& squares, const Rgb& truth, const Rgbd& means) {
  double sum = 0.0;
  for (int c = 0; c < 3; ++c)
    if (squares[c] != 0.0) sum += squares[c] / relative_scale(truth[c], means[c]);
  return sum / 3.0;
}

Rgbd variance_of_means(const NoisyImage& picture) {
  if (picture.variance_of_channel_means) return *picture.variance_of_channel_means;
  if (!picture.variance) return Rgbd(0.0);
  return channel_means(*picture.variance) / static_cast<double>(picture.image.pixels.size());
}

}  // namespace

NoisyImage resampled(const NoisyImage& picture, int width, int height) {
  assert(width > 0 && height > 0);
  NoisyImage result{weighted(picture.image, width, height, 1), {}, picture.variance_of_channel_means};
  if (picture.variance) result.variance = weighted(*picture.variance, width, height, 2);
  return result;
}

NoisyDifference noisy_difference(const NoisyImage& picture, const NoisyImage& reference) {
  const Image &image = picture.image, &truth = reference.image;
  assert(image.width == truth.width && image.height == truth.height);
  const Rgbd means = channel_means(truth);
  NoisyDifference difference;
  std::vector<double> rest;  // of each pixel: the square of the difference less that of noise
  Sum noise, of_reference;
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    cancellation_point();
    const Rgb& r = truth.pixels[i];
    const Rgbd off = Rgbd(image.pixels[i]) - Rgbd(r);
    const double own = picture.variance ? relative(Rgbd(picture.variance->pixels[i]), r, means) : 0.0;
    const double others = reference.variance ? relative(Rgbd(reference.variance->pixels[i]), r, means) : 0.0;
    noise.add(own);
    of_reference.add(others);
    rest.push_back(relative(off * off, r, means) - own - others);
  }
  const auto count = static_cast<double>(rest.size());
  difference.relative_mse = relative_mse(image, truth);
  difference.noise = noise.value() / count;
  difference.noise_of_reference = of_reference.value() / count;
  difference.less_noise = difference.relative_mse - difference.noise - difference.noise_of_reference;
  difference.standard_error = standard_error_of_mean(rest, image.width);
  difference.of_channel_means = channel_means(image) - means;
  difference.standard_errors = glm::sqrt(variance_of_means(picture) + variance_of_means(reference));
  difference.means_know_correlation = picture.variance_of_channel_means && reference.variance_of_channel_means;
  return difference;
}

}  // namespace vpm
