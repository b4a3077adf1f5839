// The film: the mean of passes, pixel by pixel, and what their differences tell of its error.
#pragma once

#include <array>
#include <vector>

#include "vpm/image/image.h"

namespace vpm {

/// Variance and bias of a film's mean, told apart. A pass of radius r has a bias of b r^2 where the photons' density is
/// smooth [Silverman1986, sec. 3.3]: passes of different radii show it as the slope of a line through them.
struct FilmErrors {
  Image variance;              // of the mean, from the differences between passes
  Image bias;                  // of the mean, unbiased but full of noise
  double variance_part = 0.0;  // relative MSE due to variance: the mean over pixels and channels of
                               // variance / (mean^2 + 0.01 (mean over pixels)^2), as relative_mse()
  double bias_part = 0.0;      // the same due to bias; an unbiased estimate, which may come out below 0
};

/// Running moments of some passes [Welford1962].
struct PassMoments {
  int passes = 0;
  // Of the relative squares of radii: mean, sum of squared differences from it.
  double mean_square = 0.0, square_spread = 0.0;
  std::vector<Rgbd> mean;
  std::vector<Rgbd> squares;   // sums of squared differences from the mean
  std::vector<Rgbd> products;  // sums of products of the differences of values and of relative squares
};

/// Sums passes in double.
class Film {
 public:
  /// Passes in two halves, taken in turn. Their noise is independent, so that the product of the two halves' slopes
  /// estimates the squared bias without any noise on average.
  using Halves = std::array<PassMoments, 2>;

  Film(int width, int height);
  Film(int width, int height, Halves halves);

  /// Adds one pass of the film's size, whose kernels' squared radii are `relative_square` times those of the first
  /// pass (0: the pass has no kernel).
  void add(const Image& pass, double relative_square = 0.0);
  int width() const { return width_; }
  int height() const { return height_; }
  int passes() const { return halves_[0].passes + halves_[1].passes; }
  const Halves& halves() const { return halves_; }
  /// The mean of the passes, W/(m^2 sr).
  Image mean() const;
  /// The variance of that mean, estimated from the passes' differences. Needs two passes.
  Image variance_of_mean() const;
  /// Do the radii differ within each half, so that a bias shows?
  bool shows_bias() const { return halves_[0].square_spread > 0.0 && halves_[1].square_spread > 0.0; }
  /// Needs two passes. Where no bias shows, it is 0.
  FilmErrors errors() const;

 private:
  Rgbd mean_at(size_t pixel) const;
  Rgbd variance_at(size_t pixel) const;

  int width_, height_;
  Halves halves_;
};

}  // namespace vpm
