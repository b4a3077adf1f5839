// Numbers that say how far one picture is from another: the sums.
#include "image/metrics.h"

#include <cassert>
#include <string>

#include "base/error.h"
#include "base/statistics.h"

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
  return mean_error(image, reference, [&](int c, double value, double truth) {
    const double difference = value - truth;
    return difference == 0.0 ? 0.0 : difference * difference / (truth * truth + 0.01 * means[c] * means[c]);
  });
}

}  // namespace vpm
