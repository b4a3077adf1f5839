// Black bodies against an independent sum over the same colour matching functions.
#include "vpm/medium/blackbody.h"

#include <gtest/gtest.h>

#include <array>

#include "vpm/base/rng.h"

namespace vpm {
namespace {

struct Row {
  double kelvin;
  Vec3d xyz;
};
/// Of ../oracles/README.md, S9g: W/(m^2 sr).
const std::array kRows{
    Row{1000.0, {0.00745502070380482, 0.003934071397535299, 3.1836997133097884e-05}},
    Row{2000.0, {865.2828689820462, 679.0096717439878, 98.61641972787757}},
    Row{4000.0, {373769.8379644091, 370142.06785377045, 238557.5580090315}},
};

TEST(Blackbody, HasTheColourOfPlancksLaw) {
  for (const Row& row : kRows) {
    const Vec3d xyz = blackbody_xyz(row.kelvin);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(xyz[c] / row.xyz[c], 1.0, 1e-12) << row.kelvin;
  }
}

TEST(Blackbody, IsThatSumInSrgbClamped) {
  Rng rng(1, rng_stream(RngUse::test, 0), 0);
  for (int i = 0; i < 2000; ++i) {
    double kelvin = 401.0 + 21'000.0 * rng.uniform_double();
    if (i % 4 == 0) kelvin *= std::exp(8.0 * rng.uniform_double());
    const Rgbd exact = linear_srgb_of_xyz(blackbody_xyz(kelvin)), looked_up = blackbody(kelvin);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(looked_up[c], std::max(0.0, exact[c]), 1e-6 * max_channel(Rgb(exact))) << kelvin;
  }
  EXPECT_GT(blackbody(1000.0).g, 0.0);
  EXPECT_EQ(blackbody(1000.0).b, 0.0);
  EXPECT_EQ(blackbody(kColdestSeen), Rgbd(0.0));
  EXPECT_EQ(blackbody(-5.0), Rgbd(0.0));
}

}  // namespace
}  // namespace vpm
