// What the film makes of its passes.
#include "vpm/film/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "support/statistics.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/base/rng.h"
#include "vpm/base/statistics/moments.h"
#include "vpm/image/metrics.h"

namespace vpm {
namespace {

Image grey(int width, int height, float value) {
  Image image(width, height);
  for (Rgb& pixel : image.pixels) pixel = Rgb(value);
  return image;
}

/// Passes of the truth 1, 2, 3 and a bias, whose corrections show so much of it. The noise of both has the standard
/// deviation `sigma`.
struct FilmOf {
  int passes = 12;
  double bias = 0.0, shown = 1.0, sigma = 0.1;
  int pixels = 64;

  Film film(uint64_t seed) const {
    Film film(pixels, 1);
    for (int pass = 0; pass < passes; ++pass) {
      Image image(pixels, 1), correction(pixels, 1);
      for (int i = 0; i < pixels; ++i) {
        Rng rng(seed, static_cast<uint64_t>(pass), static_cast<uint64_t>(i));
        const double off = unit_noise(rng);
        for (int c = 0; c < 3; ++c) {
          image.pixels[i][c] = static_cast<float>(c + 1 + bias + sigma * unit_noise(rng));
          correction.pixels[i][c] = static_cast<float>(-shown * bias + sigma * off);
        }
      }
      film.add(pass, image, correction);
    }
    return film;
  }
  Image truth() const {
    Image image(pixels, 1);
    for (Rgb& pixel : image.pixels) pixel = Rgb(1.0f, 2.0f, 3.0f);
    return image;
  }
};

TEST(Film, MeansAndVariancesAreThoseOfAllPasses) {
  Film film(2, 1);
  Moments all, of_picture;
  for (int pass = 0; pass < 7; ++pass) {
    const float value = 1.0f + 0.25f * static_cast<float>(pass * pass);
    Image image(2, 1);
    image.pixels = {Rgb(value), Rgb(3.0f)};
    film.add(pass, image);
    all.add(value);
    of_picture.add(0.5 * (value + 3.0));
  }
  EXPECT_EQ(film.passes(), 7);
  EXPECT_NEAR(film.mean().pixels[0].g, all.mean(), 1e-6);
  EXPECT_NEAR(film.variance_of_mean().pixels[0].b, all.variance_of_mean(), 1e-6);
  EXPECT_EQ(film.mean().pixels[1].r, 3.0f);
  EXPECT_EQ(film.variance_of_mean().pixels[1].r, 0.0f);
  EXPECT_NEAR(film.errors().variance_of_channel_means.g, of_picture.variance_of_mean(), 1e-9);
  EXPECT_FALSE(film.shows_bias());
  EXPECT_EQ(film.errors().bias_part, Estimated());
}

TEST(Film, ABiasIsMinusTheMeanCorrection) {
  const FilmOf biased{.bias = 0.05, .sigma = 0.0};
  const FilmErrors errors = biased.film(1).errors();
  for (const Rgb& bias : errors.bias.pixels)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(bias[c], 0.05, 1e-6);
  // The scale is that of the mean here, that of the truth there.
  EXPECT_NEAR(errors.bias_part.value / relative_mse(biased.film(1).mean(), biased.truth()), 1.0, 0.25);
  EXPECT_NEAR(errors.bias_part.standard_error, 0.0, 1e-7);
}

// False alarms: 4.5 standard errors, 1 in 150,000 for each of the two.
TEST(Film, NoiseAddsNothingToTheSquaredBiasOnAverage) {
  for (const double bias : {0.0, 0.05}) {
    const FilmOf biased{.passes = 10, .bias = bias, .pixels = 16};
    Moments parts;
    for (uint64_t seed = 0; seed < 400; ++seed) parts.add(biased.film(seed).errors().bias_part.value);
    FilmOf exact = biased;
    exact.sigma = 0.0;
    const double part = exact.film(0).errors().bias_part.value;
    // The scale, value^2, is noisy too: some percent of what it divides.
    EXPECT_LT(std::fabs(parts.mean() - part), 4.5 * std::sqrt(parts.variance_of_mean()) + 0.03 * part) << bias;
  }
}

TEST(Film, ThePartOfVarianceIsTheRelativeErrorOfTheMean) {
  const FilmOf unbiased{.passes = 10, .sigma = 0.05};
  Moments stated, found;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const Film film = unbiased.film(seed);
    stated.add(film.errors().variance_part.value);
    found.add(relative_mse(film.mean(), unbiased.truth()));
  }
  // False alarms: 1 in 150,000. The lower of two noisy scales makes the part larger by a percent.
  const double error = std::sqrt(stated.variance_of_mean() + found.variance_of_mean());
  EXPECT_LT(std::fabs(stated.mean() - found.mean()), 4.5 * error + 0.02 * found.mean());
}

/// Where few samples of a pixel bring most of its light, it is as noisy as it is bright: its own value would hide that.
TEST(Film, APixelsNoiseDoesNotHideItsError) {
  constexpr int kSide = 24, kPasses = 16;
  Moments stated, found;
  for (uint64_t seed = 0; seed < 60; ++seed) {
    Film film(kSide, kSide);
    for (int pass = 0; pass < kPasses; ++pass) {
      Image image(kSide, kSide);
      for (size_t i = 0; i < image.pixels.size(); ++i) {
        Rng rng(seed, static_cast<uint64_t>(pass), i);
        image.pixels[i] = Rgb(rng.uniform() < 0.05f ? 20.0f : 0.0f);
      }
      film.add(pass, image);
    }
    stated.add(film.errors().variance_part.value);
    found.add(relative_mse(film.mean(), grey(kSide, kSide, 1.0f)));
  }
  // The square of a pixel alone would say a half. Where no sample has lit the darkest side of a pixel, its divisor is
  // 0.01 of the picture's squared mean for the 1.01 that is true: as long as many sides are black, too much is stated.
  EXPECT_GT(stated.mean() / found.mean(), 0.8);
  EXPECT_LT(stated.mean() / found.mean(), 20.0);
}

constexpr int kRareSide = 24;

/// How stated errors compare with true ones where a sample of a pixel is `lamp` with its probability, `wall` otherwise.
double stated_over_true(const std::function<double(int x, int y)>& probability, double lamp, double wall) {
  Moments stated, found;
  for (uint64_t seed = 0; seed < 60; ++seed) {
    Film film(kRareSide, kRareSide);
    Image truth(kRareSide, kRareSide);
    for (int pass = 0; pass < 16; ++pass) {
      Image image(kRareSide, kRareSide);
      for (int y = 0; y < kRareSide; ++y)
        for (int x = 0; x < kRareSide; ++x) {
          Rng rng(seed, static_cast<uint64_t>(pass), static_cast<uint64_t>(y * kRareSide + x));
          const double p = probability(x, y);
          image.at(x, y) = Rgb(static_cast<float>(rng.uniform_double() < p ? lamp : wall));
          truth.at(x, y) = Rgb(static_cast<float>(p * lamp + (1.0 - p) * wall));
        }
      film.add(pass, image);
    }
    stated.add(film.errors().variance_part.value);
    found.add(relative_mse(film.mean(), truth));
  }
  return stated.mean() / found.mean();
}

/// Pixels beside lamps, which few of their samples see, from one in 3000 to one in three. Most of the error is that of
/// pixels that one or two samples have made too bright, and whose neighbours on one side are bright as well.
TEST(Film, RareSamplesBesideABrightPlaceAreSeen) {
  const auto probability = [](int across, int along) {
    if (across % 4 == 1) return 1.0;  // columns of four: a lamp, with pixels beside it, and one apart from it
    return across % 4 == 3 ? 0.0 : std::pow(10.0, -3.5 + 3.0 * (along + 0.5) / kRareSide);
  };
  for (const bool rows : {false, true}) {
    const double ratio =
        stated_over_true([&](int x, int y) { return rows ? probability(y, x) : probability(x, y); }, 10.0, 0.5);
    // The smaller of the pixel and the mean of all its neighbours would say 0.59.
    EXPECT_GT(ratio, 0.8) << rows;
    EXPECT_LT(ratio, 1.25) << rows;
  }
}

/// Rare samples in the dark: the pixel's own square would say a half of their error.
TEST(Film, RareSamplesInTheDarkAreSeen) {
  const double ratio = stated_over_true([](int, int) { return 1e-3; }, 10.0, 0.5);
  EXPECT_GT(ratio, 0.8);
  EXPECT_LT(ratio, 1.25);
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
    for (int pass = 0; pass < kPasses; ++pass)
      whole.add(pass, passes[static_cast<size_t>(pass)], passes[static_cast<size_t>(kPasses - 1 - pass)]);
    Rng rng(seed, 1, 0);
    std::vector<int> order(kPasses);
    std::iota(order.begin(), order.end(), 0);
    for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[rng.bits() % i]);
    std::vector<Film> parts(1 + rng.bits() % 5, Film(31, 3));
    for (const int pass : order)
      parts[rng.bits() % parts.size()].add(pass, passes[static_cast<size_t>(pass)],
                                           passes[static_cast<size_t>(kPasses - 1 - pass)]);
    Film merged(31, 3);
    for (const Film& part : parts) merged.merge(part);
    EXPECT_EQ(merged.sums(), whole.sums());
    EXPECT_TRUE(same_bits(merged.mean(), whole.mean()));
    EXPECT_TRUE(same_bits(merged.variance_of_mean(), whole.variance_of_mean()));
    const FilmErrors a = merged.errors(), b = whole.errors();
    EXPECT_TRUE(same_bits(a.variance, b.variance));
    EXPECT_TRUE(same_bits(a.bias, b.bias));
    EXPECT_EQ(whole.variance_of_mean().pixels[0], Rgb(0.0f));
    if (seed % 2 == 0) continue;  // squares beyond the range of floats
    EXPECT_EQ(a.variance_part, b.variance_part);
    EXPECT_EQ(a.bias_part, b.bias_part);
  }
}

TEST(Film, TellsTheSameErrorsOnAnyNumberOfThreads) {
  const Film film = FilmOf{.passes = 8, .bias = 0.05, .pixels = 200'000}.film(1);
  set_threads(1);
  const FilmErrors alone = film.errors();
  for (int threads = 2; threads <= 8; ++threads) {
    set_threads(threads);
    const FilmErrors shared = film.errors();
    EXPECT_TRUE(same_bits(shared.variance, alone.variance));
    EXPECT_TRUE(same_bits(shared.bias, alone.bias));
    EXPECT_EQ(shared.variance_part, alone.variance_part);
    EXPECT_EQ(shared.bias_part, alone.bias_part);
  }
  set_threads(0);
}

TEST(Film, TellsGroupsByThePassesNumbers) {
  Image one(1, 1), two(1, 1);
  one.pixels[0] = Rgb(1.0f);
  two.pixels[0] = Rgb(2.0f);
  Film film(1, 1);
  film.add(7, one, one);
  film.add(3, two, two);
  film.add(4, one, one);
  EXPECT_EQ(film.sums().passes.ranges(), (std::vector<PassRange>{{3, 5}, {7, 8}}));
  EXPECT_EQ(film.sums().passes.first_missing(), 0);
  EXPECT_EQ(film.sums().passes.first_missing(3), 5);
  EXPECT_EQ(film.sums().passes.count_of(0, 4), 1);
  EXPECT_EQ(film.sums().passes.count_of(1, 4), 0);
  EXPECT_EQ(film.sums().passes.count_of(3, 4), 2);
  EXPECT_EQ(film.sums().corrections[3][0].totals().high[0], 3.0);
  EXPECT_EQ(film.errors().bias_part.standard_error, std::numeric_limits<double>::infinity()) << "of two groups alone";
  Film other(1, 1);
  other.add(4, two);
  EXPECT_THROW(film.merge(other), InputError);
  EXPECT_EQ(film.passes(), 3);
  for (const int pass : {1, 0, 2}) film.add(pass, one);
  EXPECT_EQ(film.sums().passes.first_missing(), 5);
  EXPECT_EQ(film.sums().passes.first_missing(7), 8);
  EXPECT_EQ(film.sums().passes.first_missing(8), 8);
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
      values.push_back(static_cast<float>(3.0 * (1.0 + spread * unit_noise(rng))));
      Image image(1, 1);
      image.pixels[0] = Rgb(values.back());
      film.add(pass, image);
    }
    const auto n = static_cast<long double>(kPasses);
    long double mean = 0.0, squares = 0.0;
    for (const float value : values) mean += value / n;
    for (const float value : values) squares += (value - mean) * (value - mean);
    const FilmErrors errors = film.errors();
    EXPECT_FLOAT_EQ(errors.variance.pixels[0].g, static_cast<float>(squares / (n * (n - 1))));
  }
}

}  // namespace
}  // namespace vpm
