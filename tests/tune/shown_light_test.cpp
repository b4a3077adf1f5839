// What two ways show of the same light: exact, of means and standard errors that are given.
#include "vpm/tune/shown_light.h"

#include <gtest/gtest.h>

namespace vpm {
namespace {

/// Two blocks of three equal channels.
ShownLight two_blocks(double first, double second, double standard_error) {
  const auto block = [&](double mean) {
    const Shown shown{mean, standard_error, 0.0, 4.0};
    return std::array{shown, shown, shown};
  };
  return {block(first), block(second)};
}

TEST(ShownLight, ThereIsNoneInBlackBlocks) {
  EXPECT_TRUE(is_black(two_blocks(0.0, 0.0, 0.0)));
  EXPECT_FALSE(is_black(two_blocks(0.0, 1e-30, 0.0)));
}

/// The errors of sums: sqrt(6) times those of one block and channel.
TEST(ShownLight, OneIsDarkerByTenPercentAndTwoStandardErrors) {
  const ShownLight own = two_blocks(0.2, 0.6, 0.0);
  EXPECT_FALSE(is_clearly_darker(own, two_blocks(0.3, 0.58, 0.0))) << "by less than a tenth";
  EXPECT_TRUE(is_clearly_darker(own, two_blocks(0.3, 0.6, 0.0)));
  const double limit = 0.3 / (2.0 * std::sqrt(6.0));
  EXPECT_TRUE(is_clearly_darker(own, two_blocks(0.3, 0.6, 0.99 * limit)));
  EXPECT_FALSE(is_clearly_darker(own, two_blocks(0.3, 0.6, 1.01 * limit))) << "by chance";
  EXPECT_FALSE(is_clearly_darker(two_blocks(0.3, 0.6, 0.0), own));
}

/// Only what one shows beyond four standard errors of both counts, over the square of the other's light.
TEST(ShownLight, WhatOneMissesCountsBeyondChance) {
  const ShownLight all = two_blocks(1.0, 1.0, 0.05), half = two_blocks(1.0, 0.0, 0.05);
  EXPECT_EQ(unseen_by(all, half), 0.0);
  EXPECT_EQ(unseen_by(all, all), 0.0);
  const double missing = 1.0 - 2.0 * 4.0 * 0.05;
  EXPECT_NEAR(unseen_by(half, all), 0.5 * missing * missing / 1.01, 1e-12);
}

}  // namespace
}  // namespace vpm
