// Sums, moments and tails against known values (tails: 40 digits of mpmath); ends of tails, and their inverses.
#include "vpm/base/statistics/moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "vpm/base/rng.h"
#include "vpm/base/statistics/line_fit.h"
#include "vpm/base/statistics/tails.h"

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

TEST(RisingLine, GoesThroughValuesOfALine) {
  const Line line = rising_line(std::vector<PointOfLine>{{1.0, 5.0, 1.0}, {3.0, 11.0, 2.0}, {8.0, 26.0, 1.0}});
  EXPECT_NEAR(line.at, 2.0, 1e-9);
  EXPECT_NEAR(line.by, 3.0, 1e-9);
  EXPECT_NEAR(line(2.0), 8.0, 1e-9);
}

TEST(RisingLine, NeitherFallsNorBeginsBelowZero) {
  const Line level = rising_line(std::vector<PointOfLine>{{1.0, 2.0, 1.0}, {2.0, 1.0, 1.0}});
  EXPECT_EQ(level.by, 0.0);
  EXPECT_NEAR(level.at, 1.2, 1e-12);  // of relative squares: (1/2 + 1/1) / (1/4 + 1/1)
  const Line from_zero = rising_line(std::vector<PointOfLine>{{1.0, 1.0, 1.0}, {2.0, 4.0, 1.0}});
  EXPECT_EQ(from_zero.at, 0.0);
  EXPECT_NEAR(from_zero.by, 1.2, 1e-12);  // (1/1 + 2/4) / (1/1 + 4/16)
}

TEST(RisingLine, ValuesOfZeroSayNothing) {
  EXPECT_EQ(rising_line({}).at, 0.0);
  EXPECT_EQ(rising_line(std::vector<PointOfLine>{{1.0, 0.0, 1.0}}).by, 0.0);
  const Line one = rising_line(std::vector<PointOfLine>{{1.0, 0.0, 1.0}, {5.0, 3.0, 1.0}});
  EXPECT_DOUBLE_EQ(one.at, 3.0);
  EXPECT_EQ(one.by, 0.0);
}

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

TEST(NormalTail, KnownValues) {
  EXPECT_EQ(normal_tail(0.0), 1.0);
  const double known[][2] = {{0.5, 0.61707507745197379},     {1.0, 0.3173105078629141},
                             {-3.0, 0.0026997960632601891},  {5.0, 5.7330314375838782e-7},
                             {10.0, 1.5239706048321052e-23}, {30.0, 9.8134278542963741e-198}};
  for (const auto& [z, p] : known) EXPECT_NEAR(normal_tail(z) / p, 1.0, 1e-12) << z;
  EXPECT_TRUE(std::isnan(normal_tail(kNotANumber)));
}

TEST(NormalQuantile, KnownValues) {
  const double known[][2] = {{0.5, 0.67448975019608174},  {0.05, 1.9599639845400542}, {0.01, 2.5758293035489008},
                             {1e-3, 3.2905267314918948},  {1e-6, 4.8916384756985904}, {1e-12, 7.1305068481713245},
                             {1e-100, 21.305940069351527}};
  for (const auto& [p, z] : known) EXPECT_NEAR(normal_quantile(p), z, 1e-13 * z) << p;
  EXPECT_NEAR(normal_quantile(1.0), 0.0, 1e-15);
}

TEST(Chi2Tail, KnownValues) {
  const double known[][3] = {// statistic, degrees of freedom, p
                             {3.841458820694124, 1, 0.050000000000000057},
                             {0.5, 1, 0.47950012218695346},
                             {2.0, 2, 0.36787944117144232},
                             {1e-6, 3, 0.99999999973403856},
                             {10, 10, 0.44049328506521241},
                             {100, 50, 3.4549313829848639e-5},
                             {30, 99, 0.99999999999833578},
                             {120, 99, 0.07424385580596679},
                             {1000, 1000, 0.49405285382923964},
                             {1100, 1000, 0.014614408126295194},
                             {900, 1000, 0.98928276190871026},
                             {100000, 100000, 0.49940529189520669},
                             {101000, 100000, 0.01286884037723367},
                             {50, 5, 1.3857973367009593e-9},
                             {600, 3, 1.0078435921645642e-129},
                             {0.3, 0.5, 0.33317180231535664}};
  for (const auto& [x, dof, p] : known)
    EXPECT_NEAR(chi2_tail(x, dof) / p, 1.0, 1e-12 * std::min(10.0, 1.0 + dof)) << x << " " << dof;
}

TEST(Chi2Tail, Ends) {
  EXPECT_EQ(chi2_tail(0.0, 7.0), 1.0);
  EXPECT_EQ(chi2_tail(HUGE_VAL, 7.0), 0.0);
  EXPECT_EQ(chi2_tail(1e6, 7.0), 0.0);
  EXPECT_TRUE(std::isnan(chi2_tail(kNotANumber, 7.0)));
}

TEST(Chi2Tail, AgreesWithTheNormalTailForOneDegree) {
  for (double z = 0.1; z < 8.0; z += 0.1) EXPECT_NEAR(chi2_tail(z * z, 1.0) / normal_tail(z), 1.0, 1e-10) << z;
}

TEST(StudentTail, ClosedFormsOfFewDegrees) {
  for (const double t : {0.0, 0.01, 0.5, 1.0, 2.0, 5.0, 40.0}) {
    const double sine = t / std::sqrt(10.0 + t * t), square = 10.0 / (10.0 + t * t);
    const double ten = sine * (1 + square / 2 * (1 + square * 3 / 4 * (1 + square * 5 / 6 * (1 + square * 7 / 8))));
    EXPECT_NEAR(student_tail(t, 1.0), 1.0 - 2.0 / M_PI * std::atan(t), 1e-14) << t;
    EXPECT_NEAR(student_tail(-t, 2.0), 1.0 - t / std::sqrt(2.0 + t * t), 1e-14) << t;
    EXPECT_NEAR(student_tail(t, 10.0), 1.0 - ten, 1e-14) << t;
  }
}

TEST(StudentTail, BecomesNormal) {
  // the quantile's expansion in 1 / dof starts z + (z^3 + z) / (4 dof)
  for (const double z : {0.5, 1.0, 3.0, 5.0}) {
    const double dof = 1e5, t = z + (z * z * z + z) / (4.0 * dof);
    EXPECT_NEAR(student_tail(t, dof) / normal_tail(z), 1.0, 1e-8 * z * z * z * z * z) << z;
  }
  EXPECT_NEAR(student_tail(2.0, 1e12) / normal_tail(2.0), 1.0, 1e-10);
  EXPECT_DOUBLE_EQ(student_tail(2.0, HUGE_VAL), normal_tail(2.0));
  EXPECT_TRUE(std::isnan(student_tail(kNotANumber, 7.0)));
}

TEST(StudentQuantile, IsTheInverseOfTheTail) {
  for (const double dof : {1.0, 3.0, 15.5, 1e4})
    for (const double p : {1e-6, 0.05, 0.5, 1.0})
      EXPECT_NEAR(student_tail(student_quantile(p, dof), dof) / p, 1.0, 1e-12);
}

}  // namespace
}  // namespace vpm
