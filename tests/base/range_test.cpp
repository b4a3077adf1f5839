// Ranges of numbers: which belong to them, in either precision, and how they are told.
#include "vpm/base/settings/range.h"

#include <gtest/gtest.h>

namespace vpm {
namespace {

TEST(Range, HoldsClosedEndsInEitherPrecision) {
  const Range closed{0.1, 0.7, false, false}, open{0.1, 0.7, true, true};
  for (const double end : {0.1, 0.7}) {
    EXPECT_TRUE(contains(closed, end));
    EXPECT_TRUE(contains(closed, static_cast<float>(end)));
    EXPECT_FALSE(contains(open, end));
    EXPECT_FALSE(contains(open, static_cast<float>(end)));
  }
  EXPECT_TRUE(contains(open, 0.5));
  EXPECT_FALSE(contains(closed, 0.71));
  EXPECT_FALSE(contains(kPositive, 1e-60)) << "0 in single precision";
  EXPECT_FALSE(contains(kNotNegative, std::numeric_limits<double>::quiet_NaN()));
}

TEST(Range, IsToldAsPeopleWriteIt) {
  EXPECT_EQ(text_of(kAny), "finite");
  EXPECT_EQ(text_of(kPositive), "> 0");
  EXPECT_EQ(text_of(kNotNegative), ">= 0");
  EXPECT_EQ(text_of(kFraction), "in [0, 1]");
  EXPECT_EQ(text_of(Range{1e-6, 2.0, true, true}), "in (1e-06, 2)");
}

}  // namespace
}  // namespace vpm
