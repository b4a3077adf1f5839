// Moments over repetitions, pixel by pixel.
#include "vpm/study/compare/errors.h"

#include <cassert>
#include <cmath>

#include "vpm/base/statistics/moments.h"
#include "vpm/image/metrics.h"
#include "vpm/study/compare/resampling.h"

namespace vpm {
namespace {

/// What squared errors of a picture are divided by, channel by channel, to be those of relative_mse().
class Scales {
 public:
  explicit Scales(const Image& truth) : truth_(truth), means_(channel_means(truth)) {}

  double at(size_t pixel, int channel) const { return relative_scale(truth_.pixels[pixel][channel], means_[channel]); }

 private:
  const Image& truth_;
  Rgbd means_;
};

/// The mean over pixels and channels of value(pixel, channel).
template <class Value>
double mean_over(const Image& image, Value&& value) {
  Sum sum;
  for (size_t i = 0; i < image.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) sum.add(value(i, c));
  return sum.value() / (3.0 * static_cast<double>(image.pixels.size()));
}

/// Of a squared error over its scale: none where nothing is, as in a channel that is black everywhere.
double over(double square, double scale) { return square == 0.0 ? 0.0 : square / scale; }

double brightness(const Image& image) { return sum_channels(channel_means(image)); }

/// The standard error of a reference's brightness over it, were its pixels independent and their channels as one.
double relative_error_of_brightness(const Reference& reference) {
  Sum variance;
  for (const Rgb& pixel : reference.variance.pixels) {
    const Rgbd error = glm::sqrt(Rgbd(pixel));
    variance.add(sum_channels(error) * sum_channels(error));
  }
  return std::sqrt(variance.value()) / static_cast<double>(reference.mean.pixels.size()) / brightness(reference.mean);
}

/// RepeatedErrors::distances.
std::vector<std::vector<double>> distances_of(const std::vector<Image>& images, const Scales& scales) {
  std::vector<std::vector<double>> distances(images.size());
  for (size_t k = 0; k < images.size(); ++k)
    for (size_t l = 0; l < k; ++l)
      distances[k].push_back(mean_over(images[k], [&](size_t i, int c) {
        const double off = double{images[k].pixels[i][c]} - images[l].pixels[i][c];
        return over(off * off, scales.at(i, c));
      }));
  return distances;
}

/// RepeatedErrors::deviations: a square of a difference from the mean is the mean square of differences from all, less
/// half the mean square of all differences.
std::vector<double> deviations_of(const std::vector<std::vector<double>>& distances) {
  const auto n = static_cast<double>(distances.size());
  std::vector<double> from_all(distances.size(), 0.0);
  double sum = 0.0;
  for (size_t k = 0; k < distances.size(); ++k)
    for (size_t l = 0; l < k; ++l) {
      from_all[k] += distances[k][l];
      from_all[l] += distances[k][l];
      sum += distances[k][l];
    }
  for (double& deviation : from_all) deviation = n / (n - 1.0) * (deviation / n - sum / (n * n));
  return from_all;
}

}  // namespace

double reference_noise(const Reference& reference) { return relative_variance(reference.variance, reference.mean); }

PictureErrors picture_errors(const Image& image, const Reference& reference) {
  const Image& variance = reference.variance;
  const double noise = mean_over(variance, [&](size_t i, int c) { return double{variance.pixels[i][c]}; });
  const double noise_of_pbrt = mean_over(variance, [&](size_t i, int c) {
    return over(variance.pixels[i][c], scale_of_pbrt(reference.mean.pixels[i][c]));
  });
  return {mse(image, reference.mean) - noise, relative_mse(image, reference.mean) - reference_noise(reference),
          relative_mse_of_pbrt(image, reference.mean) - noise_of_pbrt, brightness(image) / brightness(reference.mean)};
}

RepeatedErrors repeated_errors(const std::vector<Image>& images, const Reference& reference) {
  assert(images.size() >= 3);
  std::vector<double> mses, relatives, biases;
  for (const Image& image : images) {
    const PictureErrors errors = picture_errors(image, reference);
    mses.push_back(errors.mse);
    relatives.push_back(errors.relative_mse);
    biases.push_back(errors.mean_ratio - 1.0);
  }
  const Scales scales(reference.mean);
  const auto squared_bias = [&](const std::vector<double>& weights) {
    return mean_over(reference.mean, [&](size_t i, int c) {
      Moments seen;
      for (size_t k = 0; k < images.size(); ++k)
        if (weights[k] > 0.0) seen.add(images[k].pixels[i][c]);
      const double off = seen.mean() - reference.mean.pixels[i][c];
      return over(off * off - seen.variance_of_mean() - reference.variance.pixels[i][c], scales.at(i, c));
    });
  };
  RepeatedErrors result;
  result.mse = mean_with_interval(mses);
  result.relative_mse = mean_with_interval(relatives);
  // All repetitions have the same reference: its error moves all of them alike.
  const Tested bias = mean_beside(biases, relative_error_of_brightness(reference));
  result.bias = bias.value;
  result.bias_p = bias.p;
  result.squared_bias = jackknife(images.size(), squared_bias);
  result.variance = result.relative_mse.value - result.squared_bias.value;
  result.distances = distances_of(images, scales);
  result.deviations = deviations_of(result.distances);
  return result;
}

}  // namespace vpm
