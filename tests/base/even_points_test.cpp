// A few points lie evenly in the square, and each is uniform in it.
#include "vpm/base/even_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/statistics.h"

namespace vpm {
namespace {

/// The point that Rng::uniform2() makes of a draw.
Vec2 point_of(uint64_t draw) {
  Rng rng(1, rng_stream(RngUse::test, 0), 0);
  rng.lead({&draw, 1});
  return rng.uniform2();
}

/// Of 2^k points each cell of 2^-a by 2^-(k - a) holds one, wherever the first lies along the axis that is turned.
TEST(EvenPoints, AreOneInEachCell) {
  constexpr uint32_t kBits = 4;
  Rng rng(2, rng_stream(RngUse::test, 0), 0);
  for (int turn = 0; turn < 20; ++turn) {
    const EvenPoints points(1u << kBits, rng);
    const float first = point_of(points[0]).x;
    for (uint32_t a = 0; a <= kBits; ++a) {
      std::vector<int> found(1u << kBits, 0);
      for (uint32_t i = 0; i < 1u << kBits; ++i) {
        const Vec2 p = point_of(points[i]);
        const float from_first = p.x - first + (p.x < first - 1e-6f ? 1.0f : 0.0f) + 0.5f / (1u << kBits);
        const auto x = static_cast<uint32_t>(from_first * static_cast<float>(1u << a));
        const auto y = static_cast<uint32_t>(p.y * static_cast<float>(1u << (kBits - a)));
        ++found[(x % (1u << a)) << (kBits - a) | y];
      }
      for (const int count : found) EXPECT_EQ(count, 1) << a;
    }
  }
}

/// Along the turned axis any number of points lie at equal distances.
TEST(EvenPoints, StandAtEqualDistances) {
  Rng rng(3, rng_stream(RngUse::test, 0), 0);
  for (const uint32_t number : {1u, 3u, 7u, 100u}) {
    const EvenPoints points(number, rng);
    std::vector<float> x;
    for (uint32_t i = 0; i < number; ++i) x.push_back(point_of(points[i]).x);
    std::sort(x.begin(), x.end());
    for (uint32_t i = 0; i < number; ++i) {
      const float next = i + 1 < number ? x[i + 1] : x[0] + 1.0f;
      EXPECT_NEAR(next - x[i], 1.0f / static_cast<float>(number), 1e-6f) << number;
    }
  }
}

/// Moments of both coordinates, of each point.
TEST(EvenPoints, AreUniformEachByItself) {
  Rng rng(4, rng_stream(RngUse::test, 0), 0);
  constexpr uint32_t kNumber = 6;
  Moments x[kNumber], y[kNumber], product[kNumber];
  for (int turn = 0; turn < 20'000; ++turn) {
    const EvenPoints points(kNumber, rng);
    for (uint32_t i = 0; i < kNumber; ++i) {
      const Vec2 p = point_of(points[i]);
      x[i].add(p.x);
      y[i].add(p.y);
      product[i].add(p.x * p.y);
    }
  }
  for (uint32_t i = 0; i < kNumber; ++i) {
    expect_mean(x[i], 0.5, 1e-6);
    expect_mean(y[i], 0.5, 1e-6);
    expect_mean(product[i], 0.25, 1e-6);
  }
}

}  // namespace
}  // namespace vpm
