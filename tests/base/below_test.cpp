// Picking numbers below a limit, against the plain way.
#include "vpm/base/below.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "vpm/base/rng.h"

namespace vpm {
namespace {

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

}  // namespace
}  // namespace vpm
