// Pictures in half floats against the format's definition.
#include "vpm/image/half_pixels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vpm {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// What the bits of a half stand for [IEEE2019, sec. 3.4, binary16].
double value_of(uint16_t bits) {
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  const double sign = bits & 0x8000 ? -1.0 : 1.0;
  if (exponent == 31) return fraction ? std::nan("") : sign * kInfinity;
  return sign * (exponent ? std::ldexp(1024 + fraction, exponent - 25) : std::ldexp(fraction, -24));
}

/// The values of a picture of one row after it was in halves.
std::vector<double> there_and_back(const std::vector<Rgb>& pixels) {
  Image image(static_cast<int>(pixels.size()), 1);
  image.pixels = pixels;
  const HalfPixels halves = to_half(image);
  std::vector<double> values;
  for (const uint16_t bits : halves.bits) values.push_back(std::ldexp(value_of(bits), halves.exponent));
  return values;
}

TEST(HalfPixels, ElevenBitsAreExactInTheOrderOfPixelsAndChannels) {
  for (const float scale : {1.0f, 1e30f, 3e38f / 2047.0f, 1e-30f}) {
    const float unit = std::ldexp(1.0f, std::ilogb(scale));
    const std::vector<double> values =
        there_and_back({{2047.0f * unit, -1025.0f * unit, 3.0f * unit}, {0.0f, 0.125f * unit, -unit}});
    EXPECT_EQ(values, (std::vector<double>{2047.0 * unit, -1025.0 * unit, 3.0 * unit, 0.0, 0.125 * unit, -1.0 * unit}));
  }
}

TEST(HalfPixels, RoundsByHalfAnElevenBitUnitOverEightDecades) {
  for (double x = 12345.678; x > 12345.678e-8; x *= 0.917) {
    const double back = there_and_back({{12345.678f, static_cast<float>(x), 0.0f}})[1];
    EXPECT_LE(std::abs(back - static_cast<float>(x)), std::ldexp(static_cast<float>(x), -11)) << x;
  }
}

TEST(HalfPixels, WhatIsNotFiniteStaysAndDecidesNothing) {
  const std::vector<double> values = there_and_back({{kInfinity, -kInfinity, std::nanf("")}, {1e-20f, 0.0f, -2e-20f}});
  EXPECT_EQ(values[0], kInfinity);
  EXPECT_EQ(values[1], -kInfinity);
  EXPECT_TRUE(std::isnan(values[2]));
  EXPECT_NEAR(values[3], 1e-20, 1e-23);
  EXPECT_NEAR(values[5], -2e-20, 1e-23);
}

TEST(HalfPixels, BlackIsBlack) { EXPECT_EQ(there_and_back({Rgb(0.0f)}), (std::vector<double>{0.0, 0.0, 0.0})); }

}  // namespace
}  // namespace vpm
