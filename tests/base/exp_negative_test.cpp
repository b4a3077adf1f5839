// The exponential of what is not positive, against that of doubles.
#include "vpm/base/exp_negative.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace vpm {
namespace {

TEST(ExpNegative, IsOffByAtMostThreeHalvesOfAnUlp) {
  // Every 61st float from 0 to -87, over all magnitudes.
  double worst = 0.0;
  for (uint32_t bits = 0; bits <= std::bit_cast<uint32_t>(87.0f); bits += 61) {
    const float x = -std::bit_cast<float>(bits);
    const double exact = std::exp(static_cast<double>(x));
    const float nearest = static_cast<float>(exact);
    const double ulp = static_cast<double>(nearest) - std::nextafter(nearest, 0.0f);
    worst = std::max(worst, std::abs(exp_negative(x) - exact) / ulp);
  }
  EXPECT_LE(worst, 1.5);
}

TEST(ExpNegative, EndsWellAtTheEnds) {
  EXPECT_EQ(exp_negative(0.0f), 1.0f);
  EXPECT_EQ(exp_negative(-0.0f), 1.0f);
  EXPECT_EQ(exp_negative(-1e-30f), 1.0f);
  EXPECT_GT(exp_negative(-87.0f), 0.0f);
  for (const float x : {-87.1f, -1e3f, -1e38f, -std::numeric_limits<float>::infinity()})
    EXPECT_EQ(exp_negative(x), 0.0f);
}

/// So that what is wrong is counted where light is added up, and is not taken for darkness.
TEST(ExpNegative, OfNoNumberIsNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float x : {nan, -nan}) {
    EXPECT_TRUE(std::isnan(exp_negative(x)));
    Floats some(-1.0f);
    some.set(5, x);
    EXPECT_TRUE(std::isnan(exp_negative(some)[5]));
    EXPECT_EQ(exp_negative(some)[4], exp_negative(-1.0f));
  }
}

TEST(ExpNegative, IsTheSameOfManyNumbersAtOnce) {
  for (uint32_t bits = 0; bits <= std::bit_cast<uint32_t>(90.0f); bits += 61 * kBlock) {
    Floats x;
    for (uint32_t i = 0; i < kBlock; ++i) x.set(i, -std::bit_cast<float>(bits + 61 * i));
    const Floats all = exp_negative(x);
    for (uint32_t i = 0; i < kBlock; ++i) ASSERT_EQ(all[i], exp_negative(x[i])) << x[i];
  }
}

}  // namespace
}  // namespace vpm
