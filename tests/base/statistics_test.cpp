// Sums, moments and tails against known values (tails: 40 digits of mpmath).
#include "vpm/base/statistics.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "vpm/base/line_fit.h"
#include "vpm/base/rng.h"

namespace vpm {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(Sum, KeepsWhatPlainAdditionLoses) {
  Sum sum;
  for (const double x : {1.0, 1e100, 1.0, -1e100}) sum.add(x);
  EXPECT_EQ(sum.value(), 2.0);  // plain addition: 0; without Neumaier's comparison: 0 too

  Sum tenths;
  for (int i = 0; i < 10'000'000; ++i) tenths.add(0.1);
  EXPECT_EQ(tenths.value(), 1e6);
}

TEST(Sum, MergesExactly) {
  Sum a, b;
  a.add(1.0);
  a.add(1e100);
  b.add(1.0);
  b.add(-1e100);
  a.merge(b);
  EXPECT_EQ(a.value(), 2.0);
  EXPECT_EQ(Sum().value(), 0.0);
}

TEST(Sum, ShowsNonFiniteTerms) {
  Sum infinite, broken;
  for (const double x : {1.0, kInf, 1.0}) infinite.add(x);
  for (const double x : {1.0, kNaN, 1.0}) broken.add(x);
  EXPECT_EQ(infinite.value(), kInf);
  EXPECT_TRUE(std::isnan(broken.value()));
}

TEST(Moments, OfAKnownSample) {
  Moments moments;
  for (const double x : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}) moments.add(x);
  EXPECT_EQ(moments.count(), 8u);
  EXPECT_DOUBLE_EQ(moments.mean(), 5.0);
  EXPECT_DOUBLE_EQ(moments.variance(), 32.0 / 7.0);
  EXPECT_DOUBLE_EQ(moments.variance_of_mean(), 4.0 / 7.0);
}

TEST(Moments, VarianceIsUnknownBelowTwoSamples) {
  Moments moments;
  EXPECT_EQ(moments.mean(), 0.0);
  EXPECT_TRUE(std::isnan(moments.variance()));
  moments.add(3.0);
  EXPECT_EQ(moments.mean(), 3.0);
  EXPECT_TRUE(std::isnan(moments.variance_of_mean()));
}

TEST(Moments, KeepTheVarianceOfLargeNumbers) {
  Moments moments;
  for (int i = 0; i < 1000; ++i) moments.add(1e9 + i % 2);  // the sum of squares would lose it
  EXPECT_NEAR(moments.variance(), 0.25 * 1000 / 999, 1e-9);
}

TEST(Moments, MergeEqualsOneByOne) {
  Rng rng(1, rng_stream(RngUse::test, 0), 0);
  Moments all;
  std::vector<Moments> parts(5);  // the last one stays empty
  for (size_t i = 0; i < 1000; ++i) {
    const double x = 10.0 + rng.uniform_double();
    all.add(x);
    parts[i < 10 ? 0 : 1 + i % 3].add(x);
  }
  Moments merged;
  for (const Moments& part : parts) merged.merge(part);
  EXPECT_EQ(merged.count(), all.count());
  EXPECT_NEAR(merged.mean(), all.mean(), 1e-13 * all.mean());
  EXPECT_NEAR(merged.variance(), all.variance(), 1e-11 * all.variance());
}

TEST(LineFit, HasTheSlopeAndItsErrorOfLeastSquares) {
  const std::vector<double> x{0.0, 1.0, 2.0, 3.0};
  const LineFit straight = fit_line(x, std::vector<double>{1.0, -1.0, -3.0, -5.0});
  EXPECT_DOUBLE_EQ(straight.slope, -2.0);
  EXPECT_NEAR(straight.slope_error, 0.0, 1e-15);
  // Off the line y = x by 1, -1, -1, 1: slope 1, variance 4 / (4 - 2), over the squares 5 of x about its mean.
  const LineFit bent = fit_line(x, std::vector<double>{1.0, 0.0, 1.0, 4.0});
  EXPECT_DOUBLE_EQ(bent.slope, 1.0);
  EXPECT_DOUBLE_EQ(bent.slope_error, std::sqrt(2.0 / 5.0));
  EXPECT_TRUE(std::isnan(fit_line(std::vector<double>{0.0, 2.0}, std::vector<double>{0.0, 1.0}).slope_error));
}

}  // namespace
}  // namespace vpm
