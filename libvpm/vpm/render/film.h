// The film: the mean of passes, pixel by pixel, and what the differences between passes tell of its error. The result
// does not depend on the order of the passes, nor on how films of some of them were merged.
#pragma once

#include <array>
#include <vector>

#include "vpm/base/exact_sums.h"
#include "vpm/image/image.h"
#include "vpm/render/pass_set.h"

namespace vpm {

/// Estimates of the variance and of the bias of a film's mean. A pass of radius r has a bias of b r^2 where the
/// photons' density is smooth [Silverman1986, sec. 3.3]. Passes of different radii show it as the slope of a line
/// through them.
struct FilmErrors {
  Image variance;              // of the mean, from the differences between passes
  Image bias;                  // of the mean; an unbiased estimate, but full of noise
  double variance_part = 0.0;  // relative MSE due to variance: the mean over pixels and channels of
                               // variance / (mean^2 + 0.01 (mean over pixels)^2), as relative_mse()
  double bias_part = 0.0;      // the same due to bias; an unbiased estimate, which may come out below 0
};

/// What a film sums, by blocks of ExactSums::kCount values: three to a pixel, rows from the top.
struct FilmSums {
  /// The sums of the even passes, or of the odd ones. The noise of the two halves is independent, so the product of
  /// their slopes estimates the squared bias without any noise on average.
  struct Half {
    ExactSums squares;                // of radii, relative: [0] their sum, [1] that of their squares
    std::vector<ExactSums> values;    // W/(m^2 sr)
    std::vector<ExactSums> products;  // of values and relative squares of radii

    bool operator==(const Half&) const = default;
  };
  PassSet passes;
  std::array<Half, 2> halves;
  std::vector<ExactSums> squares;  // of values, of all passes

  bool operator==(const FilmSums&) const = default;
};

/// Sums passes without rounding error. The film of a set of passes is the same to the last bit, in whatever order they
/// are added, and however films of some of them are merged. Only two things are rounded: what passes give, floats, and
/// what is read off the sums. The relative error of a mean is that of a double. So is that of a variance, though it is
/// a difference of nearly equal sums; it is about n 2^-54 for n passes that differ only in the last bits of their
/// floats.
///
/// A pixel takes 190 bytes where a block of 42 pixels has nearly one brightness, 260 where the passes of each block
/// span 4 decades, 280 where they span 10 and 340 where they span 20 (512 x 512 pixels after 64 passes: 49, 67, 74 and
/// 89 MB).
class Film {
 public:
  static constexpr size_t kBytesOfPixel = 300;  // for estimates of sizes

  Film(int width, int height);
  /// Of sums of a film of that size.
  Film(int width, int height, FilmSums sums);
  /// How many blocks a film of that size has.
  static size_t blocks(int width, int height);

  /// Adds pass number `pass` >= 0, which the film does not have yet. Its image has the film's size and finite pixels.
  /// The squared radii of its kernels are `relative_square` times those of the first pass (0: the pass has no kernel).
  /// Throws std::domain_error where a pixel is not finite; the film must not be used then.
  void add(int pass, const Image& image, float relative_square = 0.0f);
  /// Adds the passes of another film of the same size. Throws InputError where both films have a pass of the same
  /// number.
  void merge(const Film& other);
  int width() const { return width_; }
  int height() const { return height_; }
  int passes() const { return sums_.passes.count(); }
  /// The number of the next pass: the least that the film does not have.
  int next_pass() const { return sums_.passes.first_missing(); }
  const FilmSums& sums() const { return sums_; }
  /// The mean of the passes, W/(m^2 sr); black where there is none.
  Image mean() const;
  /// The variance of that mean, estimated from the passes' differences. Needs two passes.
  Image variance_of_mean() const;
  /// Do the radii differ within each half, so that a bias shows?
  bool shows_bias() const;
  /// Needs two passes. Where no bias shows, it is 0.
  FilmErrors errors() const;

 private:
  int width_, height_;
  FilmSums sums_;
};

}  // namespace vpm
