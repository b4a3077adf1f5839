// The equirectangular environment: orientation, density, integral, errors.
#include <gtest/gtest.h>

#include "light/lights.h"
#include "support/statistics.h"
#include "vpm/base/error.h"

namespace vpm {
namespace {

TEST(ImageEnvironment, IsOrientedAsDocumented) {
  // Row 0 is up (+y); columns go from +z over +x.
  const ImageEnvironment image(4, 2, {Rgb(1), Rgb(2), Rgb(3), Rgb(4), Rgb(5), Rgb(6), Rgb(7), Rgb(8)});
  EXPECT_EQ(image.radiance(glm::normalize(Vec3(0.1f, 0.5f, 1.0f))), Rgb(1));
  EXPECT_EQ(image.radiance(glm::normalize(Vec3(1.0f, 0.5f, -0.1f))), Rgb(2));
  EXPECT_EQ(image.radiance(glm::normalize(Vec3(-0.1f, 0.5f, -1.0f))), Rgb(3));
  EXPECT_EQ(image.radiance(glm::normalize(Vec3(-1.0f, 0.5f, 0.1f))), Rgb(4));
  EXPECT_EQ(image.radiance(glm::normalize(Vec3(-1.0f, -0.5f, 0.1f))), Rgb(8));
  EXPECT_EQ(image.radiance({0, 1, 0}), Rgb(1));
  EXPECT_EQ(image.radiance({0, -1, 0}), Rgb(5));
  EXPECT_EQ(image.radiance(glm::normalize(Vec3(-1e-30f, 0.5f, 1.0f))), Rgb(4))
      << "a turn less an ulp is the last column";
}

TEST(ImageEnvironment, IntegratesSolidAnglesExactly) {
  const ImageEnvironment constant(17, 9, std::vector<Rgb>(17 * 9, Rgb(1, 2, 3)));
  EXPECT_NEAR(constant.integral().r, 4.0 * kPiD, 1e-12);
  EXPECT_NEAR(constant.integral().b, 12.0 * kPiD, 1e-12);
  EXPECT_FLOAT_EQ(constant.pdf({0, 1, 0}), 1.0f / (4.0f * kPi));
  // One bright texel at the pole: 2 pi / 4 (1 - cos 30 degrees).
  std::vector<Rgb> texels(24, Rgb(0));
  texels[2] = Rgb(1);
  EXPECT_NEAR(ImageEnvironment(4, 6, texels).integral().r, 0.5 * kPiD * (1.0 - std::cos(kPiD / 6)), 1e-12);
}

// Counts over a grid three times finer than the texels against pdf times solid angle; black texels stay empty.
// False-alarm rate 1e-5.
TEST(ImageEnvironment, SamplesItsDensity) {
  const EnvironmentMap map = test_map();
  Rng rng = test_rng(1);
  constexpr int kColumns = 24, kRows = 12;
  std::vector<double> counts(kColumns * kRows, 0.0), expected;
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kColumns; ++c) {
      const double theta = (r + 0.5) * kPiD / kRows, phi = (c + 0.5) * 2.0 * kPiD / kColumns;
      const Vec3 d(Vec3d(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)));
      const double cosines = std::cos(r * kPiD / kRows) - std::cos((r + 1) * kPiD / kRows);
      expected.push_back(map.image->pdf(d) * cosines * 2.0 * kPiD / kColumns);
    }
  }
  for (int i = 0; i < 200000; ++i) {
    const double choice = rng.uniform_double();
    const ImageEnvironment::Sample s = map.image->sample(choice, rng.uniform2());
    const double turn = std::atan2(s.direction.x, s.direction.z) / (2.0 * kPiD);
    const int c = std::min(kColumns - 1, static_cast<int>((turn < 0.0 ? turn + 1.0 : turn) * kColumns));
    const int r = std::min(kRows - 1, static_cast<int>(std::acos(s.direction.y) / kPi * kRows));
    counts[r * kColumns + c] += 1.0;
    ASSERT_NEAR(glm::length(s.direction), 1.0f, 1e-6f);
    ASSERT_GT(s.pdf, 0.0f);
  }
  expect_distribution(counts, expected, 1e-5);
}

// A million texels, every other one black: none of those is drawn, and the mean column is that of the others.
// False-alarm rate 1e-5.
TEST(ImageEnvironment, NeverDrawsABlackTexelAmongMany) {
  constexpr int kWidth = 1 << 20;
  std::vector<Rgb> texels(kWidth);
  for (int i = 0; i < kWidth; ++i) texels[i] = Rgb(i % 2 == 0 ? 1.0f : 0.0f);
  const ImageEnvironment image(kWidth, 1, texels);
  Rng rng = test_rng(2);
  Moments turns;
  for (int i = 0; i < 20000; ++i) {
    const double choice = rng.uniform_double();
    const ImageEnvironment::Sample s = image.sample(choice, rng.uniform2());
    ASSERT_EQ(s.radiance, Rgb(1));
    const double turn = std::atan2(s.direction.x, s.direction.z) / (2.0 * kPiD);
    turns.add(turn < 0.0 ? turn + 1.0 : turn);
  }
  expect_mean(turns, 0.5 - 0.5 / kWidth, 1e-5);
}

TEST(ImageEnvironment, RefusesBadPictures) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(ImageEnvironment(2, 1, {Rgb(1)}), InputError);
  EXPECT_THROW(ImageEnvironment(0, 0, {}), InputError);
  EXPECT_THROW(ImageEnvironment(2, 1, {Rgb(1), Rgb(0, nan, 0)}), InputError);
  EXPECT_THROW(ImageEnvironment(2, 1, {Rgb(1), Rgb(0, kInfinity, 0)}), InputError);
  EXPECT_THROW(ImageEnvironment(2, 1, {Rgb(1), Rgb(0, -1, 0)}), InputError);
  EXPECT_THROW(ImageEnvironment(2, 1, {Rgb(0), Rgb(0)}), InputError);
  EXPECT_TRUE(ImageEnvironment(2, 1, {Rgb(1), Rgb(0)}).grey());
}

}  // namespace
}  // namespace vpm
