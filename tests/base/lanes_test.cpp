// Numbers side by side against arrays, one after the other, and doubles.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "vpm/base/below.h"
#include "vpm/base/exp_negative.h"
#include "vpm/base/floats.h"
#include "vpm/base/rng.h"

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

/// Numbers >= 0, few of them different where `kinds` is small.
std::vector<float> numbers_of(size_t count, uint64_t kinds, Rng& rng) {
  std::vector<float> values(count);
  for (float& value : values)
    value = static_cast<float>(std::floor(rng.uniform_double() * static_cast<double>(kinds))) * 0.37f;
  return values;
}

TEST(Below, AppendsThoseBelowInTheirOrder) {
  Rng rng(1, rng_stream(RngUse::test, 0), 0);
  for (uint32_t count = 0; count <= kBlock; ++count)
    for (const float limit : {0.0f, 0.37f, 3.0f, 100.0f}) {
      const std::vector<float> values = numbers_of(kBlock, 20, rng);
      std::vector<float> found(kBlock), expected;
      std::vector<uint32_t> numbers(kBlock), expected_numbers;
      const uint32_t size = append_below(values.data(), count, limit, 1000, found.data(), numbers.data());
      for (uint32_t i = 0; i < count; ++i) {
        if (!(values[i] < limit)) continue;
        expected.push_back(values[i]);
        expected_numbers.push_back(1000 + i);
      }
      found.resize(size);
      numbers.resize(size);
      EXPECT_EQ(found, expected);
      EXPECT_EQ(numbers, expected_numbers);
    }
}

TEST(Below, KeepsThoseUpToALimitInTheirOrder) {
  Rng rng(1, rng_stream(RngUse::test, 1), 0);
  for (size_t count = 0; count < 70; ++count) {
    std::vector<float> values = numbers_of(count, 9, rng), expected;
    std::vector<uint32_t> numbers(count), expected_numbers;
    std::iota(numbers.begin(), numbers.end(), 0u);
    const float limit = 3.0f * 0.37f;
    for (size_t i = 0; i < count; ++i) {
      if (values[i] > limit) continue;
      expected.push_back(values[i]);
      expected_numbers.push_back(numbers[i]);
    }
    values.resize(count + kBlock);
    numbers.resize(count + kBlock);
    const size_t kept = keep_up_to(values.data(), numbers.data(), count, limit);
    values.resize(kept);
    numbers.resize(kept);
    EXPECT_EQ(values, expected);
    EXPECT_EQ(numbers, expected_numbers);
  }
}

TEST(Below, FindsTheKthSmallest) {
  Rng rng(1, rng_stream(RngUse::test, 2), 0);
  for (const uint64_t kinds : {uint64_t{1}, uint64_t{3}, uint64_t{1} << 20})
    for (size_t count = 1; count < 120; count += 7) {
      const std::vector<float> values = numbers_of(count, kinds, rng);
      std::vector<float> sorted = values;
      std::sort(sorted.begin(), sorted.end());
      for (size_t k = 1; k <= count; ++k) EXPECT_EQ(kth_smallest(values.data(), count, k), sorted[k - 1]);
    }
  // Of all magnitudes at once.
  const std::vector<float> values{1e30f, 0.0f, 1e-40f, 1.0f, 1e-30f, 3e38f};
  std::vector<float> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  for (size_t k = 1; k <= values.size(); ++k) EXPECT_EQ(kth_smallest(values.data(), values.size(), k), sorted[k - 1]);
}

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
