// The equirectangular environment: orientation, density, integral, errors.
#include <gtest/gtest.h>

#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "image/openexr_envmaps.h"
#include "light/lights.h"
#include "support/statistics.h"
#include "vpm/base/error.h"
#include "vpm/base/warp.h"

namespace vpm {
namespace {

/// As OpenEXR has it: row 0 is up (+y), the middle +z, and columns to the right are to the right of who looks.
TEST(ImageEnvironment, IsOrientedAsDocumented) {
  const ImageEnvironment image(4, 2, {Rgb(1), Rgb(2), Rgb(3), Rgb(4), Rgb(5), Rgb(6), Rgb(7), Rgb(8)});
  EXPECT_EQ(image.radiance(glm::normalize(Vec3(1.0f, 0.5f, -0.1f))), Rgb(1));
  EXPECT_EQ(image.radiance(glm::normalize(Vec3(1.0f, 0.5f, 0.1f))), Rgb(2)) << "looking at +x, +z is to the right";
  EXPECT_EQ(image.radiance(glm::normalize(Vec3(-0.1f, 0.5f, 1.0f))), Rgb(3));
  EXPECT_EQ(image.radiance(glm::normalize(Vec3(-1.0f, 0.5f, -0.1f))), Rgb(4));
  EXPECT_EQ(image.radiance(glm::normalize(Vec3(-1.0f, -0.5f, -0.1f))), Rgb(8));
  EXPECT_EQ(image.radiance({0, 1, 0}), Rgb(3));
  EXPECT_EQ(image.radiance({0, -1, 0}), Rgb(7));
  EXPECT_EQ(image.radiance(glm::normalize(Vec3(1e-30f, 0.5f, -1.0f))), Rgb(1));
  EXPECT_EQ(image.radiance(glm::normalize(Vec3(-1e-30f, 0.5f, -1.0f))), Rgb(1)) << "rounded to half a turn";
}

/// What OpenEXR's own functions say of directions and places.
TEST(ImageEnvironment, LiesAsOpenExrSays) {
  constexpr int kWidth = 64, kHeight = 32;
  std::vector<Rgb> texels(kWidth * kHeight);
  for (int i = 0; i < kWidth * kHeight; ++i) texels[static_cast<size_t>(i)] = Rgb(static_cast<float>(i));
  const ImageEnvironment image(kWidth, kHeight, texels);
  Rng rng = test_rng(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 d = uniform_sphere(rng.uniform2());
    const Vec2 place = place_in_latlong(d);
    const auto column = static_cast<int>(place.x * kWidth), row = static_cast<int>(place.y * kHeight);
    ASSERT_EQ(image.radiance(d).r, static_cast<float>(row * kWidth + column)) << d.x << " " << d.y << " " << d.z;
  }
}

/// A square, as pbrt-v4 has it.
TEST(ImageEnvironment, OfEqualAreasIsOrientedAsDocumented) {
  const ImageEnvironment image(2, 2, {Rgb(1), Rgb(2), Rgb(3), Rgb(4)}, SkyMapping::equal_area);
  for (const float z : {-0.9f, -0.1f, 0.1f, 0.9f}) {
    EXPECT_EQ(image.radiance(glm::normalize(Vec3(-0.3f, -0.2f, z))), Rgb(1));
    EXPECT_EQ(image.radiance(glm::normalize(Vec3(0.3f, -0.2f, z))), Rgb(2));
    EXPECT_EQ(image.radiance(glm::normalize(Vec3(-0.3f, 0.2f, z))), Rgb(3));
    EXPECT_EQ(image.radiance(glm::normalize(Vec3(0.3f, 0.2f, z))), Rgb(4));
  }
  std::vector<Rgb> texels(25, Rgb(0));
  texels[12] = Rgb(1);  // the middle: +z
  const ImageEnvironment middle(5, 5, texels, SkyMapping::equal_area);
  EXPECT_EQ(middle.radiance({0, 0, 1}), Rgb(1));
  EXPECT_EQ(middle.radiance({0, 0, -1}), Rgb(0));
  EXPECT_NEAR(middle.integral().r, 4.0 * kPiD / 25.0, 1e-12);
  EXPECT_THROW(ImageEnvironment(2, 1, {Rgb(1), Rgb(1)}, SkyMapping::equal_area), InputError);
}

/// What is drawn lies in the texel that it is drawn from, and its mean direction is that of the radiance: both
/// mappings, turned.
TEST(ImageEnvironment, PlacesAndDirectionsAreInverse) {
  const Mat3d rotation(glm::rotate(Mat4d(1.0), 0.7, glm::normalize(Vec3d(1.0, 2.0, -0.5))));
  Rng rng = test_rng(4);
  for (const SkyMapping mapping : {SkyMapping::equirectangular, SkyMapping::equal_area}) {
    std::vector<Rgb> texels;
    for (int i = 0; i < 64; ++i) texels.emplace_back(static_cast<float>(1 + i * 7 % 64));
    const ImageEnvironment image(8, 8, texels, mapping, rotation);
    int elsewhere = 0;
    for (int i = 0; i < 20000; ++i) {
      const double choice = rng.uniform_double();
      const ImageEnvironment::Sample s = image.sample(choice, 0.999f * rng.uniform2() + 0.0005f);
      ASSERT_NEAR(glm::length(s.direction), 1.0f, 1e-6f);
      elsewhere += image.radiance(s.direction) != s.radiance;
    }
    EXPECT_EQ(elsewhere, 0);
  }
}

/// The fluxes by sums over directions that are drawn: a false alarm in 1e5 tests.
TEST(ImageEnvironment, FluxesAreThoseOfItsRadiance) {
  const Mat3d rotation(glm::rotate(Mat4d(1.0), 0.7, glm::normalize(Vec3d(1.0, 2.0, -0.5))));
  Rng rng = test_rng(5);
  for (const SkyMapping mapping : {SkyMapping::equirectangular, SkyMapping::equal_area}) {
    std::vector<Rgb> texels(16, Rgb(0));
    texels[6] = Rgb(3);
    texels[9] = Rgb(1);
    const ImageEnvironment image(4, 4, texels, mapping, rotation);
    std::array<Moments, 3> fluxes;
    for (int i = 0; i < 200'000; ++i) {
      const double choice = rng.uniform_double();
      const ImageEnvironment::Sample s = image.sample(choice, rng.uniform2());
      for (int axis = 0; axis < 3; ++axis)
        fluxes[static_cast<size_t>(axis)].add(std::abs(s.direction[axis]) * s.radiance.r / s.pdf);
    }
    for (size_t axis = 0; axis < 3; ++axis) expect_mean(fluxes[axis], image.flux_across()[axis].r, 1e-5 / 6.0);
  }
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
  expect_mean(turns, 0.5 + 0.5 / kWidth, 1e-5);  // columns go against turns
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
