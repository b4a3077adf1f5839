// The film: the mean of passes and the variance of that mean, pixel by pixel.
#pragma once

#include <vector>

#include "image/image.h"

namespace vpm {

/// Sums passes in double by Welford's recurrence.
class Film {
 public:
  Film(int width, int height) : width_(width), height_(height), mean_(size_t(width) * height), squares_(mean_.size()) {}

  /// Adds one pass of the film's size.
  void add(const Image& pass) {
    ++passes_;
    for (size_t i = 0; i < mean_.size(); ++i) {
      const Rgbd value(pass.pixels[i]);
      const Rgbd delta = value - mean_[i];
      mean_[i] += delta / static_cast<double>(passes_);
      squares_[i] += delta * (value - mean_[i]);
    }
  }
  int passes() const { return passes_; }
  /// The mean of the passes, W/(m^2 sr).
  Image mean() const {
    Image image(width_, height_);
    for (size_t i = 0; i < mean_.size(); ++i) image.pixels[i] = Rgb(mean_[i]);
    return image;
  }
  /// The variance of that mean, estimated from the passes' differences. Needs two passes.
  Image variance_of_mean() const {
    Image image(width_, height_);
    const double scale = 1.0 / (static_cast<double>(passes_) * (passes_ - 1));
    for (size_t i = 0; i < mean_.size(); ++i) image.pixels[i] = Rgb(squares_[i] * scale);
    return image;
  }

 private:
  int width_, height_;
  int passes_ = 0;
  std::vector<Rgbd> mean_;
  std::vector<Rgbd> squares_;  // sums of squared differences from the mean
};

}  // namespace vpm
