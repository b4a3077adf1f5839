// How far repeated pictures of one method are from the truth, and how much of that is bias.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vpm/image/image.h"

namespace vpm {

/// A picture taken for the truth, with the variance that it has itself.
struct Reference {
  Image mean;
  Image variance;                      // of each pixel of `mean`; black: it is exact
  std::optional<PixelRect> part = {};  // the pixels that it has, where it is a crop
  std::string doubt = "";              // why biases cannot be judged against it; empty: they can
};

/// An estimate between the ends of a 95 % confidence interval.
struct ConfidenceInterval {
  double value = 0.0, lo = 0.0, hi = 0.0;
};

/// Errors of one picture. The part that the reference's own noise is expected to add is subtracted, so they are
/// unbiased, and may come out below 0 where the reference is too noisy.
struct PictureErrors {
  double mse = 0.0;                   // (W/(m^2 sr))^2
  double relative_mse = 0.0;          // as relative_mse()
  double relative_mse_of_pbrt = 0.0;  // as relative_mse_of_pbrt()
  double mean_ratio = 0.0;            // the mean over pixels and channels over the reference's
};
/// The relative MSE that the reference's own noise stands for.
double reference_noise(const Reference& reference);
PictureErrors picture_errors(const Image& image, const Reference& reference);

/// The errors of a method at one budget, from repetitions (at least 3) that are independent of each other.
struct RepeatedErrors {
  ConfidenceInterval mse, relative_mse;
  /// The bias of the mean over pixels and channels, relative to the reference's. The interval includes the reference's
  /// own noise, as far as its pixels are independent: those of paths are, those of photon maps are correlated.
  ConfidenceInterval bias;
  double bias_p = 1.0;  // probability of a bias so far from 0, were there none
  /// The relative MSE that is left when infinitely many repetitions are averaged, and the part that averages out. Both
  /// are estimated without bias: the first may come out below 0.
  ConfidenceInterval squared_bias;
  double variance = 0.0;
  /// By two repetitions, the second before the first: the relative mean square of their difference. Half their mean is
  /// an unbiased estimate of the variance, too. The reference's noise enters only through its scale.
  std::vector<std::vector<double>> distances;
  /// By repetition: the relative mean square of its difference from the mean of all, times n/(n - 1). Their mean is
  /// that same estimate, but they are correlated by the mean they share.
  std::vector<double> deviations;
};
RepeatedErrors repeated_errors(const std::vector<Image>& images, const Reference& reference);

}  // namespace vpm
