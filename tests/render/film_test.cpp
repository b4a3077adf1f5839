// What the film makes of its passes.
#include "vpm/render/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "vpm/base/rng.h"
#include "vpm/base/statistics.h"
#include "vpm/estimate/radius_schedule.h"
#include "vpm/image/metrics.h"

namespace vpm {
namespace {

/// The kernel's size in a pass of a 2D map.
double size_of(int pass) { return measure_of_pass(2.0 / 3.0, pass); }

double noise(Rng& rng) { return std::sqrt(12.0) * (rng.uniform_double() - 0.5); }

/// Passes of value `truth` + slope * size, with noise as a kernel makes it: a variance of `sigma`^2 / size.
Film film_of(int passes, double truth, double slope, double sigma, uint64_t seed, int pixels = 64) {
  Film film(pixels, 1);
  for (int pass = 0; pass < passes; ++pass) {
    Image image(pixels, 1);
    for (int i = 0; i < pixels; ++i) {
      Rng rng(seed, static_cast<uint64_t>(pass), static_cast<uint64_t>(i));
      for (int c = 0; c < 3; ++c)
        image.pixels[static_cast<size_t>(i)][c] =
            static_cast<float>(truth * (c + 1) + slope * size_of(pass) + sigma / std::sqrt(size_of(pass)) * noise(rng));
    }
    film.add(image, size_of(pass));
  }
  return film;
}

TEST(Film, MeansAndVariancesAreThoseOfAllPasses) {
  Film film(2, 1);
  Moments all;
  for (int pass = 0; pass < 7; ++pass) {
    const float value = 1.0f + 0.25f * static_cast<float>(pass * pass);
    Image image(2, 1);
    image.pixels = {Rgb(value), Rgb(3.0f)};
    film.add(image, 0.0);
    all.add(value);
  }
  EXPECT_EQ(film.passes(), 7);
  EXPECT_NEAR(film.mean().pixels[0].g, all.mean(), 1e-6);
  EXPECT_NEAR(film.variance_of_mean().pixels[0].b, all.variance_of_mean(), 1e-6);
  EXPECT_EQ(film.mean().pixels[1].r, 3.0f);
  EXPECT_EQ(film.variance_of_mean().pixels[1].r, 0.0f);
  EXPECT_FALSE(film.shows_bias());
  EXPECT_EQ(film.errors().bias_part, 0.0);
}

TEST(Film, ShowsABiasThatGoesWithTheSquaredRadius) {
  constexpr int kPasses = 12;
  const Film film = film_of(kPasses, 2.0, 0.5, 0.0, 1, 4);
  double mean_size = 0.0;
  for (int pass = 0; pass < kPasses; ++pass) mean_size += size_of(pass) / kPasses;
  const FilmErrors errors = film.errors();
  for (const Rgb& bias : errors.bias.pixels)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(bias[c], 0.5 * mean_size, 1e-5);
  Image truth(4, 1);
  for (Rgb& pixel : truth.pixels) pixel = Rgb(2.0f, 4.0f, 6.0f);
  // The scale is that of the mean here, that of the truth there.
  EXPECT_NEAR(errors.bias_part / relative_mse(film.mean(), truth), 1.0, 0.25);
}

// False alarms: 4.5 standard errors, 1 in 150,000 for each of the two.
TEST(Film, NoiseAddsNothingToTheSquaredBiasOnAverage) {
  for (const double slope : {0.0, 0.05}) {
    Moments bias_part;
    for (uint64_t seed = 0; seed < 400; ++seed) {
      const FilmErrors errors = film_of(10, 1.0, slope, 0.1, seed, 16).errors();
      bias_part.add(errors.bias_part);
    }
    const double exact = film_of(10, 1.0, slope, 0.0, 0, 16).errors().bias_part;
    // The scale, value^2, is noisy too: a few tenths of a percent of what it divides.
    EXPECT_LT(std::fabs(bias_part.mean() - exact), 4.5 * std::sqrt(bias_part.variance_of_mean()) + 0.005 * exact);
  }
}

TEST(Film, ThePartOfVarianceIsTheRelativeErrorOfTheMean) {
  Image truth(64, 1);
  for (Rgb& pixel : truth.pixels) pixel = Rgb(1.0f, 2.0f, 3.0f);
  Moments stated, found;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const Film film = film_of(10, 1.0, 0.0, 0.05, seed);
    stated.add(film.errors().variance_part);
    found.add(relative_mse(film.mean(), truth));
  }
  // False alarms: 1 in 150,000. The scale's noise is of the order of 0.1 %.
  const double error = std::sqrt(stated.variance_of_mean() + found.variance_of_mean());
  EXPECT_LT(std::fabs(stated.mean() - found.mean()), 4.5 * error + 0.002 * found.mean());
}

}  // namespace
}  // namespace vpm
