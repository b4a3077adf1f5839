// What passes take and leave, by lines through what is measured: exact.
#include "vpm/tune/pass_model.h"

#include <gtest/gtest.h>

namespace vpm {
namespace {

/// What goes with photons goes with the area that they are gathered in.
TEST(PassModel, WiderRadiiTakeLonger) {
  PassModel model;
  model.making = {0.5, 1e-6};
  model.seeing = {0.25, 2e-6};
  EXPECT_DOUBLE_EQ(model.seconds(1e5, 1.0), 0.5 + 0.1 + 0.25 + 0.2);
  EXPECT_DOUBLE_EQ(model.seconds(1e5, 2.0), 0.5 + 0.1 + 0.25 + 0.8);
}

/// The noise of rays falls with passes; radii that shrink let the bias fall, and hold up the noise of photons: by the
/// factors 1, 5/6 and 5/6 * 8/9 of the areas of discs in the first three passes.
TEST(PassModel, ErrorsFallAsRadiiShrink) {
  RenderSettings settings;
  settings.radii = RadiusSchedule::constant;
  PassModel model;
  model.noise = {4e-3, 2.0};
  model.bias2 = 1e-3;
  model.power_of_noise = 2.0;
  EXPECT_DOUBLE_EQ(model.error(8, 1000.0, 1.0, settings), 6e-3 / 8 + 1e-3);
  EXPECT_DOUBLE_EQ(model.error(8, 1000.0, 2.0, settings), 4.5e-3 / 8 + 1e-3 * std::pow(2.0, kPowerOfBias));
  settings.radii = RadiusSchedule::per_pass;
  const double second = 5.0 / 6.0, third = second * 8.0 / 9.0;
  model.bias2 = 0.0;
  EXPECT_NEAR(model.error(3, 1000.0, 1.0, settings), (4e-3 + 2e-3 / 3 * (1.0 + 1.0 / second + 1.0 / third)) / 3, 1e-9);
  model = {};
  model.bias2 = 9e-3;
  const double bias = 1.0 + std::pow(second, 0.25 * kPowerOfBias) + std::pow(third, 0.25 * kPowerOfBias);
  EXPECT_NEAR(model.error(3, 1000.0, 1.0, settings), 1e-3 * bias * bias, 1e-9);
}

TEST(PassModel, LightThatRaysHaveNotMetIsNoise) {
  PassModel model;
  model.unseen = 0.08;
  EXPECT_DOUBLE_EQ(model.error(4, 0.0, 1.0, {}), 0.02);
}

}  // namespace
}  // namespace vpm
