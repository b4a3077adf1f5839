// What the film makes of its passes.
#include "vpm/render/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "vpm/base/error.h"
#include "vpm/base/rng.h"
#include "vpm/base/statistics.h"
#include "vpm/estimate/radius_schedule.h"
#include "vpm/image/metrics.h"

namespace vpm {
namespace {

/// The kernel's size in a pass of a 2D map.
float size_of(int pass) { return static_cast<float>(measure_of_pass(2.0 / 3.0, pass)); }

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
    film.add(pass, image, size_of(pass));
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
    film.add(pass, image);
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
  for (int pass = 0; pass < kPasses; ++pass) mean_size += double{size_of(pass)} / kPasses;
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

/// Passes whose values are of either sign and spread over `decades`, a grey pixel among them.
std::vector<Image> wide_passes(int count, double decades, uint64_t seed) {
  std::vector<Image> passes;
  Rng rng(seed, 0, 0);
  for (int pass = 0; pass < count; ++pass) {
    Image image(31, 3);
    for (size_t i = 1; i < image.pixels.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const double magnitude = std::pow(10.0, decades * (rng.uniform_double() - 0.5));
        image.pixels[i][c] = static_cast<float>(rng.uniform_double() < 0.3 ? -magnitude : magnitude);
      }
    image.pixels[0] = Rgb(0.25f);
    passes.push_back(std::move(image));
  }
  return passes;
}

bool same_bits(const Image& a, const Image& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Rgb)) == 0;
}

TEST(Film, IsTheSameInAnyOrderAndGroupingOfPasses) {
  for (uint64_t seed = 0; seed < 12; ++seed) {
    constexpr int kPasses = 23;
    const std::vector<Image> passes = wide_passes(kPasses, seed % 2 == 0 ? 60.0 : 4.0, seed);
    Film whole(31, 3);
    for (int pass = 0; pass < kPasses; ++pass) whole.add(pass, passes[static_cast<size_t>(pass)], size_of(pass));
    Rng rng(seed, 1, 0);
    std::vector<int> order(kPasses);
    std::iota(order.begin(), order.end(), 0);
    for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[rng.bits() % i]);
    std::vector<Film> parts(1 + rng.bits() % 5, Film(31, 3));
    for (const int pass : order)
      parts[rng.bits() % parts.size()].add(pass, passes[static_cast<size_t>(pass)], size_of(pass));
    Film merged(31, 3);
    for (const Film& part : parts) merged.merge(part);
    EXPECT_EQ(merged.sums(), whole.sums());
    EXPECT_TRUE(same_bits(merged.mean(), whole.mean()));
    EXPECT_TRUE(same_bits(merged.variance_of_mean(), whole.variance_of_mean()));
    const FilmErrors a = merged.errors(), b = whole.errors();
    EXPECT_TRUE(same_bits(a.variance, b.variance));
    EXPECT_TRUE(same_bits(a.bias, b.bias));
    EXPECT_EQ(a.variance_part, b.variance_part);
    EXPECT_EQ(a.bias_part, b.bias_part);
    EXPECT_EQ(whole.variance_of_mean().pixels[0], Rgb(0.0f));
  }
}

TEST(Film, TellsHalvesByThePassesNumbers) {
  Image one(1, 1), two(1, 1);
  one.pixels[0] = Rgb(1.0f);
  two.pixels[0] = Rgb(2.0f);
  Film film(1, 1);
  film.add(7, one);
  film.add(3, two);
  film.add(4, one);
  EXPECT_EQ(film.sums().passes.ranges(), (std::vector<PassRange>{{3, 5}, {7, 8}}));
  EXPECT_EQ(film.next_pass(), 0);
  EXPECT_EQ(film.sums().passes.count_of(0), 1);
  EXPECT_EQ(film.sums().passes.count_of(1), 2);
  EXPECT_EQ(film.sums().halves[1].values[0].totals().high[0], 3.0);
  Film other(1, 1);
  other.add(4, two);
  EXPECT_THROW(film.merge(other), InputError);
  EXPECT_EQ(film.passes(), 3);
  for (const int pass : {1, 0, 2}) film.add(pass, one);
  EXPECT_EQ(film.next_pass(), 5);
  for (const int pass : {6, 5}) film.add(pass, one);
  EXPECT_EQ(film.sums().passes.ranges(), (std::vector<PassRange>{{0, 8}}));
}

TEST(Film, RefusesPixelsThatAreNotFinite) {
  for (const float value : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    Image image(9, 4);
    image.pixels[35].b = value;
    Film film(9, 4);
    EXPECT_THROW(film.add(0, image), std::domain_error);
  }
}

/// Against moments about the mean, in long double.
TEST(Film, KeepsTheDigitsOfSmallDifferences) {
  constexpr int kPasses = 200;
  for (const double spread : {1e-6, 1e-3, 1.0}) {
    Film film(1, 1);
    std::vector<float> values;
    Rng rng(5, 0, 0);
    for (int pass = 0; pass < kPasses; ++pass) {
      values.push_back(static_cast<float>(3.0 * (1.0 + spread * noise(rng))));
      Image image(1, 1);
      image.pixels[0] = Rgb(values.back());
      film.add(pass, image, size_of(pass));
    }
    const auto n = static_cast<long double>(kPasses);
    long double mean = 0.0, mean_size = 0.0, squares = 0.0;
    for (int pass = 0; pass < kPasses; ++pass) {
      mean += values[static_cast<size_t>(pass)] / n;
      mean_size += double{size_of(pass)} / n;
    }
    for (const float value : values) squares += (value - mean) * (value - mean);
    std::array<long double, 2> biases{};
    for (int h = 0; h < 2; ++h) {
      long double of_half = 0.0, size_of_half = 0.0, products = 0.0, sizes = 0.0;
      for (int pass = h; pass < kPasses; pass += 2) {
        of_half += values[static_cast<size_t>(pass)] / (n / 2);
        size_of_half += double{size_of(pass)} / (n / 2);
      }
      for (int pass = h; pass < kPasses; pass += 2) {
        const long double size = size_of(pass) - size_of_half;
        products += (values[static_cast<size_t>(pass)] - of_half) * size;
        sizes += size * size;
      }
      biases[static_cast<size_t>(h)] = products / sizes * mean_size;
    }
    const FilmErrors errors = film.errors();
    const long double scale = 1.01 * mean * mean;
    // The scale's mean over pixels is that of a picture of floats.
    EXPECT_NEAR(errors.variance_part / static_cast<double>(squares / (n * (n - 1)) / scale), 1.0, 2e-9);
    EXPECT_NEAR(errors.bias_part / static_cast<double>(biases[0] * biases[1] / scale), 1.0, 2e-9);
    EXPECT_FLOAT_EQ(errors.variance.pixels[0].g, static_cast<float>(squares / (n * (n - 1))));
    EXPECT_FLOAT_EQ(errors.bias.pixels[0].g, static_cast<float>((biases[0] + biases[1]) / 2));
  }
}

}  // namespace
}  // namespace vpm
