// The film: the mean of passes, pixel by pixel, and its estimated error. The result does not depend on the
// order of the passes, nor on how films of some of them were merged.
#pragma once

#include <array>
#include <vector>

#include "vpm/base/statistics/exact_sums.h"
#include "vpm/film/pass.h"
#include "vpm/image/image.h"

namespace vpm {

/// An estimate and its standard error, itself estimated.
struct Estimated {
  double value = 0.0, standard_error = 0.0;

  bool operator==(const Estimated&) const = default;
};

/// Estimates of the variance and of the bias of a film's mean. Relative parts are those in relative_mse(): means over
/// pixels and channels, over R^2 + 0.01 (mean R)^2. A pixel's own value is too noisy to stand for R where its error is
/// large, as a sample that makes the error makes it seem small, too. So R^2 is a product a d: a is the magnitude of the
/// pixel's own value, but no more than that of the mean of its neighbours, d the same with the mean of its darkest
/// side; neither is less than the pixel's own less its standard deviation.
struct FilmErrors {
  Image variance;  // of the mean, from the differences between passes
  Image bias;      // of the mean, were it to go as r^2: an unbiased estimate, but full of noise
  /// Relative MSE due to variance. Its standard error is by how much the squared error of this picture is off from
  /// its mean, were pixels independent but for a factor that all have in common.
  Estimated variance_part;
  /// Relative MSE due to bias, were it to go as r^2 everywhere; four times as much were it to go as r. Estimated by
  /// products of corrections of different passes, whose noise is independent: without bias, so that it may come out
  /// below 0. Its standard error is that of a jackknife over Film::kGroups groups of passes, which is rather too large
  /// than too small [Efron1981].
  Estimated bias_part;
  Rgbd variance_of_channel_means{0.0};  // of the mean over pixels, whatever the correlation between pixels
};

/// What a film sums. Images are cut into blocks of ExactSums::kCount values: three to a pixel, rows from the top.
struct FilmSums {
  static constexpr int kGroups = 4;
  PassSet passes;
  std::vector<ExactSums> values;   // W/(m^2 sr), of all passes
  std::vector<ExactSums> squares;  // of values
  /// Of the corrections of passes number g, g + kGroups, g + 2 kGroups, ... The noise of groups is independent.
  std::array<std::vector<ExactSums>, kGroups> corrections;
  ExactSums channel_means;  // of passes: [0] to [2] sums of red, green, blue, [3] to [5] of their squares

  bool operator==(const FilmSums&) const = default;
};

/// Sums passes without rounding error. The film of a set of passes is the same to the last bit, in whatever order they
/// are added, and however films of some of them are merged. Only two things are rounded: what passes give, floats and
/// the means of their channels, and what is read off the sums. The relative error of a mean is that of a double. So is
/// that of a variance, though it is a difference of nearly equal sums; it is about n 2^-54 for n passes that differ
/// only in the last bits of their floats.
class Film {
 public:
  static constexpr size_t kBytesOfPixel = 350;       // for estimates of sizes
  static constexpr size_t kBytesOfPlainPixel = 120;  // of passes without corrections
  static constexpr int kGroups = FilmSums::kGroups;

  Film(int width, int height);
  /// Of sums of a film of that size.
  Film(int width, int height, FilmSums sums);
  /// How many blocks a film of that size has.
  static size_t blocks(int width, int height);

  /// Adds pass number `pass` >= 0, which the film does not have yet. Its image has the film's size and finite pixels;
  /// so has its correction (see Pass), or it is empty: the pass has no kernel. Throws std::domain_error where a pixel
  /// is not finite; the film must not be used then.
  void add(int pass, const Image& image, const Image& correction = {});
  /// Adds the passes of another film of the same size. Throws InputError where both films have a pass of the same
  /// number.
  void merge(const Film& other);
  int width() const { return width_; }
  int height() const { return height_; }
  int passes() const { return sums_.passes.count(); }
  const FilmSums& sums() const { return sums_; }
  /// The mean of the passes, W/(m^2 sr); black where there is none.
  Image mean() const;
  /// The variance of that mean, estimated from the passes' differences. Needs two passes.
  Image variance_of_mean() const;
  /// Is a correction of the passes not 0, so that they have kernels?
  bool shows_bias() const;
  /// Needs two passes. Parts of bias are 0 where no bias shows, and their standard error is infinite where fewer than
  /// three groups have passes.
  FilmErrors errors() const;

 private:
  int width_, height_;
  FilmSums sums_;
};

}  // namespace vpm
