// Points that lie evenly are as even as they are said to be, and random.
#include "vpm/base/even_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/statistics.h"
#include "vpm/base/statistics/moments.h"

namespace vpm {
namespace {

ScrambledSobol scrambling(uint64_t number) { return ScrambledSobol(Rng(3, rng_stream(RngUse::test, 0), number)); }

double coordinate(const ScrambledSobol::Point& point, int dimension) {
  return static_cast<double>(point[static_cast<size_t>(dimension)]) * 0x1p-32;
}

TEST(ScrambledSobol, HoldsOnePointInEachIntervalOfEachAxis) {
  for (uint64_t n = 0; n < 4; ++n) {
    const ScrambledSobol sobol = scrambling(n);
    for (const uint32_t bits : {4u, 10u}) {
      const uint32_t points = 1u << bits;
      for (uint32_t block = 0; block < 3; ++block)  // of consecutive points
        for (size_t d = 0; d < ScrambledSobol::kDimensions; ++d) {
          std::vector<int> found(points, 0);
          for (uint32_t i = 0; i < points; ++i) ++found[sobol[block * points + i][d] >> (32 - bits)];
          for (const int count : found) ASSERT_EQ(count, 1) << "dimension " << d << ", 2^" << bits << " points";
        }
    }
  }
}

/// Each cell of 2^-a by 2^-b of the first two axes holds one of 2^(a + b) points, whatever a and b: a (0, 2)-sequence.
TEST(ScrambledSobol, HoldsOnePointInEachCellOfTheFirstTwoAxes) {
  const ScrambledSobol sobol = scrambling(9);
  for (uint32_t a = 0; a <= 10; ++a) {
    std::vector<int> found(1024, 0);
    for (uint32_t i = 0; i < 1024; ++i) {
      const ScrambledSobol::Point p = sobol[i];
      const uint64_t x = uint64_t{p[0]} >> (32 - a), y = uint64_t{p[1]} >> (22 + a);
      ++found[(x << (10 - a)) | y];
    }
    for (const int count : found) ASSERT_EQ(count, 1) << a;
  }
}

/// Sobol's property A: of 2^16 consecutive points one lies in each orthant of the cube of 16 dimensions.
TEST(ScrambledSobol, HoldsOnePointInEachOrthant) {
  const ScrambledSobol sobol = scrambling(5);
  std::vector<int> found(1u << ScrambledSobol::kDimensions, 0);
  for (uint32_t i = 0; i < found.size(); ++i) {
    size_t orthant = 0;
    for (const uint32_t x : sobol[i]) orthant = (orthant << 1) | (x >> 31);
    ++found[orthant];
  }
  for (const int count : found) ASSERT_EQ(count, 1);
}

/// Two scramblings differ by more than a shift: what lies between two points is not the same.
TEST(ScrambledSobol, MixesDigits) {
  const ScrambledSobol one = scrambling(1), two = scrambling(2);
  for (size_t d = 0; d < ScrambledSobol::kDimensions; ++d)
    EXPECT_NE(one[12'345][d] ^ one[0][d], two[12'345][d] ^ two[0][d]) << d;
}

/// One point of many scramblings is uniform in each coordinate and each pair: 136 means of 4096 products each, none
/// farther off than 5 standard errors (once in 13,000 seeds).
TEST(ScrambledSobol, IsUniformInEachPointByItself) {
  constexpr int kScramblings = 4096;
  constexpr size_t kDimensions = ScrambledSobol::kDimensions;
  std::vector<double> sums(kDimensions * kDimensions, 0.0);
  for (int n = 0; n < kScramblings; ++n) {
    const ScrambledSobol::Point point = scrambling(static_cast<uint64_t>(n))[77'777];
    for (size_t a = 0; a < kDimensions; ++a)
      for (size_t b = 0; b <= a; ++b) {
        const double x = coordinate(point, static_cast<int>(a)) - 0.5, y = coordinate(point, static_cast<int>(b)) - 0.5;
        sums[a * kDimensions + b] += a == b ? x : x * y;
      }
  }
  for (size_t a = 0; a < kDimensions; ++a)
    for (size_t b = 0; b <= a; ++b) {
      const double sigma = (a == b ? std::sqrt(1.0 / 12.0) : 1.0 / 12.0) * std::sqrt(double{kScramblings});
      EXPECT_LT(std::abs(sums[a * kDimensions + b]), 5.0 * sigma) << a << ", " << b;
    }
}

/// The mean of a smooth function over 4096 points of 6 dimensions, by 64 scramblings: no bias (4.5 standard errors),
/// and a thousandth of the variance of random points.
TEST(ScrambledSobol, LeavesLittleVarianceInMeansOfSmoothFunctions) {
  constexpr int kScramblings = 64, kPoints = 4096, kAxes = 6;
  double sum = 0.0, squares = 0.0;
  for (int n = 0; n < kScramblings; ++n) {
    const ScrambledSobol sobol = scrambling(static_cast<uint64_t>(n));
    double mean = 0.0;
    for (uint32_t i = 0; i < kPoints; ++i) {
      const ScrambledSobol::Point point = sobol[i];
      double value = 1.0;
      for (int d = 0; d < kAxes; ++d) value *= 1.0 + 0.5 * (coordinate(point, d) - 0.5);
      mean += value / kPoints;
    }
    sum += mean - 1.0;
    squares += (mean - 1.0) * (mean - 1.0);
  }
  const double random = (std::pow(1.0 + 0.25 / 12.0, kAxes) - 1.0) / kPoints;
  EXPECT_LT(squares / kScramblings, 1e-3 * random);
  EXPECT_LT(std::abs(sum), 4.5 * std::sqrt(squares));
}

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
