// What a render states of its error, against the truth: of films whose truth is known.
#include "vpm/render/stated_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/statistics.h"
#include "vpm/base/rng.h"
#include "vpm/image/metrics.h"

namespace vpm {
namespace {

constexpr int kSide = 12;

/// A film whose values have the bias that a kernel of radius r causes: `strength` r^order. r shrinks from pass to pass,
/// as the bias and its correction do. Pixels are noisy by themselves, and in columns of 4 together, as those that share
/// photons are.
Film film_of(int passes, double strength, double order, uint64_t seed) {
  constexpr double kSigma = 0.2;
  Film film(kSide, kSide);
  for (int pass = 0; pass < passes; ++pass) {
    Image image(kSide, kSide), correction(kSide, kSide);
    const double bias = strength * std::pow(pass + 1.0, -order / 6.0);
    for (int x = 0; x < kSide; ++x)
      for (int block = 0; block < kSide / 4; ++block) {
        Rng rng(seed, static_cast<uint64_t>(pass), static_cast<uint64_t>(x * kSide + block));
        const double shared = unit_noise(rng), of_correction = unit_noise(rng);
        const double here = bias * (x % 3 == 0 ? -1.0 : 1.0);
        for (int y = 4 * block; y < 4 * block + 4; ++y) {
          image.at(x, y) = Rgb(static_cast<float>(1.0 + here + kSigma * (0.7 * shared + 0.7 * unit_noise(rng))));
          correction.at(x, y) = Rgb(static_cast<float>(-0.5 * order * here + kSigma * of_correction));
        }
      }
    film.add(pass, image, correction);
  }
  return film;
}

double true_error(const Film& film, const Rgb& true_value) {
  Image truth(kSide, kSide);
  for (Rgb& pixel : truth.pixels) pixel = true_value;
  return relative_mse(film.mean(), truth);
}

/// Of how many films the true error is what was stated.
struct Covered {
  int within = 0, below = 0, films = 0;

  void add(const Film& film, const Rgb& true_value = Rgb(1.0f)) {
    const StatedError stated = stated_error(film.errors());
    const double truth = true_error(film, true_value);
    within += std::fabs(truth - stated.total.value) <= 1.96 * stated.total.standard_error;
    below += truth <= stated.highest;
    ++films;
  }
  void expect_claim() const {
    EXPECT_GE(within, 0.90 * films);
    EXPECT_LE(within, 0.98 * films);
    EXPECT_GE(below, 0.80 * films);
  }
};

/// The claim to users: the true error is within 1.96 standard errors of the stated one in 90 to 98 % of films, and
/// below the bound that stops a render in 80 % at least, whether there is a bias or not, and however it goes with the
/// radius.
TEST(StatedError, CoversTheTruth) {
  Covered covered;
  for (int i = 0; i < 500; ++i) {
    const double order = i % 3 == 0 ? 0.0 : i % 3;
    const double strength = order == 0.0 ? 0.0 : 0.02 * std::pow(8.0, (i % 7) / 6.0);
    covered.add(film_of(16 + i % 48, strength, order, static_cast<uint64_t>(i)));
  }
  covered.expect_claim();
}

/// A film without kernels of a picture of one colour: its noise, relative, is one number for the whole picture and one
/// for each pixel.
Film flat_film(const Rgb& colour, double in_common, double own, uint64_t seed) {
  Film film(kSide, kSide);
  for (int pass = 0; pass < 24; ++pass) {
    Rng rng(seed, static_cast<uint64_t>(pass), 0);
    const double level = 1.0 + in_common * unit_noise(rng);
    Image image(kSide, kSide);
    for (Rgb& pixel : image.pixels) pixel = colour * static_cast<float>(level + own * unit_noise(rng));
    film.add(pass, image);
  }
  return film;
}

/// The same claim where pixels are independent, where most of the error is noise that all have in common, as where few
/// photons bring most of the light, and where both are about as much: the pixels of one picture do not show what they
/// have in common. One channel may be black.
TEST(StatedError, CoversAnErrorThatAllPixelsHaveInCommon) {
  struct Noise {
    double in_common, own;
  };
  for (const Noise& noise : {Noise{0.0, 0.2}, Noise{0.2, 0.05}, Noise{0.03, 0.2}})
    for (const Rgb& colour : {Rgb(1.0f, 2.0f, 5.0f), Rgb(0.0f, 3.0f, 0.1f)}) {
      SCOPED_TRACE(testing::Message() << noise.in_common << ' ' << noise.own << ' ' << colour.r);
      Covered covered;
      for (uint64_t seed = 0; seed < 500; ++seed)
        covered.add(flat_film(colour, noise.in_common, noise.own, seed), colour);
      covered.expect_claim();
    }
}

/// One pixel that is a thousand times as bright as the others makes the mean of the picture vary, but nothing that
/// pixels have in common: the bound on the error stays near to it.
TEST(StatedError, ABrightSpotIsNoErrorInCommon) {
  Film film(kSide, kSide);
  for (int pass = 0; pass < 24; ++pass) {
    Image image(kSide, kSide);
    Rng rng(7, static_cast<uint64_t>(pass), 0);
    for (Rgb& pixel : image.pixels) pixel = Rgb(static_cast<float>(1.0 + 0.05 * unit_noise(rng)));
    image.at(5, 5) = Rgb(static_cast<float>(1000.0 + 300.0 * unit_noise(rng)));
    film.add(pass, image);
  }
  const StatedError stated = stated_error(film.errors());
  EXPECT_LT(stated.highest, 1.5 * stated.total.value);
}

TEST(StatedError, OfABlackPictureIsNothing) {
  Film film(kSide, kSide);
  for (int pass = 0; pass < 16; ++pass) film.add(pass, Image(kSide, kSide));
  EXPECT_EQ(stated_error(film.errors()).highest, 0.0);
}

TEST(StatedError, IsNeverNegativeAndTellsABiasThatIsSeen) {
  int seen = 0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const StatedError none = stated_error(film_of(16, 0.0, 0.0, seed).errors());
    EXPECT_GE(none.squared_bias.value, 0.0);
    EXPECT_GE(none.highest_squared_bias, none.squared_bias.value);
    EXPECT_GE(none.highest, none.total.value);
    seen += none.bias_seen;
    EXPECT_TRUE(stated_error(film_of(16, 0.3, 2.0, seed).errors()).bias_seen);
  }
  EXPECT_LE(seen, 2);
}

}  // namespace
}  // namespace vpm
