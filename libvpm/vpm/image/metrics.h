// How far one picture is from another: as numbers, and how much of that is noise where both are noisy.
#pragma once

#include <optional>

#include "vpm/image/image.h"

namespace vpm {

/// Luminance of linear sRGB [ITU2015, item 3.2], in the unit of its argument.
inline float luminance(const Rgb& c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

/// The mean of each channel over the pixels.
Rgbd channel_means(const Image& image);

// The errors below are means over pixels and channels, no luminance involved. They throw InputError where the sizes
// differ, and a non-finite pixel in either picture makes them non-finite.

/// Mean of (I - R)^2.
double mse(const Image& image, const Image& reference);

/// What the relative MSE divides squared errors of a value by; `mean` is that of its channel over the picture.
inline double relative_scale(double truth, double mean) { return truth * truth + 0.01 * mean * mean; }

/// Mean of (I - R)^2 / (R^2 + 0.01 mean(R)^2), mean(R) over the pixels of the same channel: the second term, a tenth of
/// the mean squared, keeps dark pixels from deciding. 0 where I = R, also in a channel that is all black.
double relative_mse(const Image& image, const Image& reference);

/// The relative MSE that these variances of a picture's values make: their mean over the same scale, by the picture's
/// own values. 0 where they are.
double relative_variance(const Image& variance, const Image& mean);

/// The same of pbrt's.
inline double scale_of_pbrt(double truth) { return (truth + 0.01) * (truth + 0.01); }

/// Mean of (I - R)^2 / (R + 0.01)^2, as pbrt has it under the name MRSE [Pharr2023]: the 0.01 is in the pictures'
/// unit, so that the number changes with their exposure. Infinite where a value of the reference is -0.01.
double relative_mse_of_pbrt(const Image& image, const Image& reference);

/// A pixel with its part in the relative MSE: the mean over channels of (I - R)^2 / (R^2 + 0.01 mean(R)^2).
struct PixelError {
  int x = 0, y = 0;  // from the left and the top
  double error = 0.0;
};
/// The `count` pixels with the largest errors, largest first, those that are not a number before all others.
std::vector<PixelError> worst_pixels(const Image& image, const Image& reference, size_t count);

/// Pixels with a channel that is infinite or no number.
size_t non_finite_pixels(const Image& image);

/// A picture, and the variances of its pixels and of its channels' means, where they are known.
struct NoisyImage {
  Image image;
  std::optional<Image> variance;  // of each pixel; finite
  std::optional<Rgbd> variance_of_channel_means;
};

/// The picture at another size: each pixel the mean of the area that it covers, with the variance that follows if
/// pixels are independent. The channels' means stay as they are.
NoisyImage resampled(const NoisyImage& picture, int width, int height);

struct NoisyDifference {
  double relative_mse = 0.0;                      // as relative_mse()
  double noise = 0.0, noise_of_reference = 0.0;   // what is expected of it from each picture's variance; 0: not known
  double less_noise = 0.0, standard_error = 0.0;  // relative_mse less both, and the standard error of that
  Rgbd of_channel_means{0.0}, standard_errors{0.0};  // picture less reference
  bool means_know_correlation = false;               // both pictures have the variance of their channels' means
};

/// Of two pictures of one size, with finite pixels. The standard error of the relative MSE allows for pixels that are
/// correlated: it is the largest that means over squares of pixels, of edges 1, 2, 4 ... give [Flyvbjerg1989]. That of
/// channel means is that of the passes where both pictures have it, and that of independent pixels where not.
NoisyDifference noisy_difference(const NoisyImage& picture, const NoisyImage& reference);

}  // namespace vpm
