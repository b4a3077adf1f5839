// How far two pictures are apart that are both noisy: what of their difference is noise, and how sure the rest is.
#pragma once

#include <optional>

#include "vpm/image/image.h"

namespace vpm {

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
  bool means_know_correlation = false;               // both pictures tell the variance of their channels' means
};

/// Of two pictures of one size, with finite pixels. The standard error of the relative MSE allows for pixels that are
/// correlated: it is the largest that means over squares of pixels, of edges 1, 2, 4 ... give [Flyvbjerg1989]. That of
/// channel means is that of the passes where both pictures tell it, and that of independent pixels where not.
NoisyDifference noisy_difference(const NoisyImage& picture, const NoisyImage& reference);

}  // namespace vpm
