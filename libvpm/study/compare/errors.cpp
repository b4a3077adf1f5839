// Moments over repetitions, pixel by pixel.
#include "study/compare/errors.h"

#include <cassert>
#include <cmath>

#include "base/statistics.h"
#include "image/metrics.h"
#include "study/compare/resampling.h"

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

/// All repetitions have the same reference: its error moves all of them alike.
Bounded widened(const Bounded& bound, double error) {
  constexpr double kNormal = 1.96;  // standard errors, of a 95 % interval
  const auto reach = [&](double own) { return std::hypot(own, kNormal * error); };
  return {bound.value, bound.value - reach(bound.value - bound.lo), bound.value + reach(bound.hi - bound.value)};
}

/// The same for the p-value: of the mean of samples over its error and the reference's.
double tested(const std::vector<double>& samples, double error) {
  Moments moments;
  for (const double sample : samples) moments.add(sample);
  if (moments.mean() == 0.0) return 1.0;
  return student_tail(moments.mean() / std::hypot(std::sqrt(moments.variance_of_mean()), error),
                      static_cast<double>(samples.size() - 1));
}

Image mean_of(const std::vector<Image>& images) {
  Image mean(images.front().width, images.front().height);
  for (size_t i = 0; i < mean.pixels.size(); ++i) {
    Rgbd sum(0.0);
    for (const Image& image : images) sum += Rgbd(image.pixels[i]);
    mean.pixels[i] = Rgb(sum / static_cast<double>(images.size()));
  }
  return mean;
}

/// RepeatedErrors::deviations.
std::vector<double> deviations_of(const std::vector<Image>& images, const Scales& scales) {
  const Image mean = mean_of(images);
  const auto n = static_cast<double>(images.size());
  std::vector<double> deviations;
  for (const Image& image : images)
    deviations.push_back(n / (n - 1.0) * mean_over(image, [&](size_t i, int c) {
                           const double off = double{image.pixels[i][c]} - mean.pixels[i][c];
                           return over(off * off, scales.at(i, c));
                         }));
  return deviations;
}

}  // namespace

double reference_noise(const Reference& reference) {
  const Scales scales(reference.mean);
  const Image& variance = reference.variance;
  return mean_over(variance, [&](size_t i, int c) { return over(variance.pixels[i][c], scales.at(i, c)); });
}

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
  const double reference_error = relative_error_of_brightness(reference);
  result.bias = widened(mean_with_interval(biases), reference_error);
  result.bias_p = tested(biases, reference_error);
  result.squared_bias = jackknife(images.size(), squared_bias);
  result.variance = result.relative_mse.value - result.squared_bias.value;
  result.deviations = deviations_of(images, scales);
  return result;
}

}  // namespace vpm
