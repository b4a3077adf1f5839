// Lanes against arrays.
#include "vpm/base/floats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vpm {
namespace {

TEST(Lanes, StoreThoseOfASetBitInTheirOrder) {
  uint32_t numbers[kBlock];
  for (uint32_t i = 0; i < kBlock; ++i) numbers[i] = 100 + i;
  for (uint32_t bits = 0; bits < 1u << kBlock; ++bits) {
    uint32_t stored[kBlock], counted[kBlock];
    const uint32_t size = store_packed(lanes_of(numbers), bits, stored);
    ASSERT_EQ(size, static_cast<uint32_t>(std::popcount(bits)));
    ASSERT_EQ(store_numbers(100, bits, counted), size);
    for (uint32_t i = 0, lane = 0; i < size; ++i, ++lane) {
      while ((bits >> lane & 1) == 0) ++lane;
      ASSERT_EQ(stored[i], 100 + lane) << "bits " << bits;
      ASSERT_EQ(counted[i], 100 + lane) << "bits " << bits;
    }
  }
}

TEST(Lanes, HaveABitForEachLaneOfAMask) {
  for (uint32_t bits = 0; bits < 1u << kBlock; ++bits) {
    LaneMask mask;
    for (size_t lane = 0; lane < kBlock; ++lane) mask.set(lane, (bits >> lane & 1) != 0 ? -1 : 0);
    ASSERT_EQ(bits_of(mask), bits);
    ASSERT_EQ(any(mask), bits != 0);
    ASSERT_EQ(lanes_in(mask), static_cast<uint32_t>(std::popcount(bits)));
  }
}

/// Every pair of numbers that may be special.
TEST(Lanes, CompareAndChooseAsNumbersDo) {
  constexpr float kNumbers[] = {0.0f,   -0.0f,     1.0f,       -1.0f,
                                1e-40f, kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()};
  const auto same = [](float a, float b) { return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b); };
  for (const float a : kNumbers)
    for (const float b : kNumbers) {
      Floats x = 5.0f, y = 7.0f;
      x.set(11, a);
      y.set(11, b);
      EXPECT_EQ((x < y)[11], a < b ? -1 : 0);
      EXPECT_EQ((x <= y)[11], a <= b ? -1 : 0);
      EXPECT_EQ((x > y)[11], a > b ? -1 : 0);
      EXPECT_EQ((x >= y)[11], a >= b ? -1 : 0);
      EXPECT_EQ((x == y)[11], a == b ? -1 : 0);
      EXPECT_TRUE(same(min(x, y)[11], a < b ? a : b)) << a << " " << b;
      EXPECT_TRUE(same(max(x, y)[11], a > b ? a : b)) << a << " " << b;
      EXPECT_TRUE(same(select(x < y, x, y)[11], a < b ? a : b)) << a << " " << b;
      EXPECT_TRUE(same(Floats(a)[3], a));
      EXPECT_EQ(min(x, y)[10], 5.0f);
    }
  EXPECT_EQ(sqrt(Floats(2.0f))[15], std::sqrt(2.0f));
  EXPECT_EQ(as_bits(Floats(1.0f))[8], 127 << 23);
  EXPECT_EQ(with_bits(LaneMask(127 << 23))[4], 1.0f);
}

}  // namespace
}  // namespace vpm
