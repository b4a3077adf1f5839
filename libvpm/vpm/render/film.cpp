// Running moments of passes, and lines through them.
#include "vpm/render/film.h"

#include <cassert>

#include "vpm/image/metrics.h"

namespace vpm {

Film::Film(int width, int height) : width_(width), height_(height) {
  const auto pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  for (PassMoments& half : halves_)
    for (std::vector<Rgbd>* plane : {&half.mean, &half.squares, &half.products}) plane->resize(pixels);
}

Film::Film(int width, int height, Halves halves) : width_(width), height_(height), halves_(std::move(halves)) {}

void Film::add(const Image& pass, double relative_square) {
  PassMoments& half = halves_[passes() % 2];
  assert(pass.pixels.size() == half.mean.size());
  ++half.passes;
  const double square_step = relative_square - half.mean_square;
  half.mean_square += square_step / half.passes;
  const double square_rest = relative_square - half.mean_square;
  half.square_spread += square_step * square_rest;
  for (size_t i = 0; i < half.mean.size(); ++i) {
    const Rgbd value(pass.pixels[i]);
    const Rgbd step = value - half.mean[i];
    half.mean[i] += step / static_cast<double>(half.passes);
    half.squares[i] += step * (value - half.mean[i]);
    half.products[i] += step * square_rest;
  }
}

Rgbd Film::mean_at(size_t pixel) const {
  const auto& [a, b] = halves_;
  return a.mean[pixel] + (b.mean[pixel] - a.mean[pixel]) * (b.passes / static_cast<double>(passes()));
}

/// The halves' squared differences, and that of their means [Chan1983].
Rgbd Film::variance_at(size_t pixel) const {
  const auto& [a, b] = halves_;
  const double n = passes();
  const Rgbd apart = b.mean[pixel] - a.mean[pixel];
  const Rgbd squares =
      a.squares[pixel] + b.squares[pixel] + apart * apart * (static_cast<double>(a.passes) * b.passes / n);
  return squares / (n * (n - 1.0));
}

Image Film::mean() const {
  Image image(width_, height_);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Rgb(mean_at(i));
  return image;
}

Image Film::variance_of_mean() const {
  assert(passes() > 1);
  Image image(width_, height_);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Rgb(variance_at(i));
  return image;
}

FilmErrors Film::errors() const {
  assert(passes() > 1);
  FilmErrors errors{Image(width_, height_), Image(width_, height_)};
  const auto& [a, b] = halves_;
  const double n = passes();
  // The mean's, whose bias is slope * relative_square.
  const double relative_square = (a.passes * a.mean_square + b.passes * b.mean_square) / n;
  const Rgbd means = channel_means(mean());
  for (size_t i = 0; i < errors.bias.pixels.size(); ++i) {
    const Rgbd variance = variance_at(i), value = mean_at(i);
    Rgbd bias_a(0.0), bias_b(0.0);
    if (shows_bias()) {
      bias_a = a.products[i] * (relative_square / a.square_spread);
      bias_b = b.products[i] * (relative_square / b.square_spread);
    }
    errors.variance.pixels[i] = Rgb(variance);
    errors.bias.pixels[i] = Rgb(0.5 * (bias_a + bias_b));
    for (int c = 0; c < 3; ++c) {
      const double scale = relative_scale(value[c], means[c]);
      if (scale == 0.0) continue;  // a black channel is exact
      errors.variance_part += variance[c] / scale;
      errors.bias_part += bias_a[c] * bias_b[c] / scale;
    }
  }
  const double count = 3.0 * static_cast<double>(errors.bias.pixels.size());
  errors.variance_part /= count;
  errors.bias_part /= count;
  return errors;
}

}  // namespace vpm
