// Numbers of two doubles: what one double loses.
#include "vpm/base/two_doubles.h"

#include <gtest/gtest.h>

namespace vpm {
namespace {

TEST(TwoDoubles, KeepWhatOneDoubleLoses) {
  const TwoDoubles third{1.0 / 3.0}, tiny{0x1p-80};
  EXPECT_EQ(((TwoDoubles{1.0} + tiny) - TwoDoubles{1.0}).value(), 0x1p-80);
  // 1/3 is rounded down by 2^-54 / 3: three times it is 1 less 2^-54.
  EXPECT_EQ((third * TwoDoubles{3.0} - TwoDoubles{1.0}).value(), -0x1p-54);
  const TwoDoubles more = TwoDoubles{1.0} + TwoDoubles{0x1p-60};
  EXPECT_EQ((more * more - TwoDoubles{1.0}).value(), 0x1p-59);
}

}  // namespace
}  // namespace vpm
