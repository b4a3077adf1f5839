// What repetitions tell of means, ratios and differences, against problems whose answers are known by construction.
#include <gtest/gtest.h>

#include "support/statistics.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/study/compare/resampling.h"

namespace vpm {
namespace {

/// Repetitions whose errors are means of squares over so many pixels, of noise of that variance; costs differ by 5 %.
Repetitions noisy(double variance, int pixels, size_t count, Rng& rng) {
  std::vector<double> errors, costs;
  for (size_t i = 0; i < count; ++i) {
    double sum = 0.0;
    for (int p = 0; p < pixels; ++p) sum += std::pow(normal(rng), 2.0);
    errors.push_back(variance * sum / pixels);
    costs.push_back(1.0 + 0.05 * normal(rng));
  }
  return {mean_of(errors), costs};
}

TEST(Resampling, IntervalsOfMeansAreStudents) {
  const ConfidenceInterval mean = mean_with_interval({1.0, 2.0, 3.0, 4.0, 5.0});
  EXPECT_DOUBLE_EQ(mean.value, 3.0);
  EXPECT_NEAR(mean.hi - 3.0, 2.776445105 * std::sqrt(0.5), 1e-8);  // t at 97.5 %, 4 degrees of freedom
  EXPECT_NEAR(3.0 - mean.lo, mean.hi - 3.0, 1e-12);
}

// Errors that are known have infinitely many degrees of freedom.
TEST(Resampling, MeansBesideWhatHasAnErrorAreWelchs) {
  const Tested even = mean_beside({1.0, 2.0, 3.0, 4.0, 5.0}, std::sqrt(0.5));
  EXPECT_NEAR(even.value.hi - 3.0, 2.119905299, 1e-8);  // t at 97.5 %, 16 degrees of freedom, of variances of 1/2
  EXPECT_NEAR(even.p, student_tail(3.0, 16.0), 1e-12);
  const Tested known = mean_beside({2.0, 2.0}, 1.0);
  EXPECT_NEAR(known.value.hi - 2.0, 1.959963985, 1e-8);
  EXPECT_NEAR(known.p, normal_tail(2.0), 1e-12);
  EXPECT_EQ(mean_beside({2.0, 2.0}, 0.0).p, 0.0);
}

TEST(Resampling, TheJackknifeOfAMeanIsStudents) {
  const std::vector<double> samples{0.3, 1.7, 0.9, 4.1, 2.2, 0.1};
  const ConfidenceInterval direct = mean_with_interval(samples);
  const ConfidenceInterval found = jackknife(samples.size(), [&](const std::vector<double>& weights) {
    double sum = 0.0, all = 0.0;
    for (size_t i = 0; i < samples.size(); ++i) {
      sum += weights[i] * samples[i];
      all += weights[i];
    }
    return sum / all;
  });
  EXPECT_NEAR(found.value, direct.value, 1e-12);
  EXPECT_NEAR(found.lo, direct.lo, 1e-12);
  EXPECT_NEAR(found.hi, direct.hi, 1e-12);
}

// Three or ten repetitions each of two estimators, one of which needs 2.5 times the cost for the same error. The
// intervals cover that in about 95 of 100 cases: in at most 273 of 300 with probability 0.003.
TEST(Resampling, RatiosKnownByConstructionLieWithinTheirIntervals) {
  int covered = 0, covered_by_three = 0, found = 0;
  Moments logs;
  for (uint64_t i = 0; i < 300; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 1), i);
    const Repetitions a = noisy(1.0, 30, 10, rng), b = noisy(2.5, 30, 10, rng);
    const Comparison by_three = compare_efficiency(noisy(1.0, 30, 3, rng), noisy(2.5, 30, 3, rng));
    covered_by_three += by_three.ratio.lo <= 2.5 && 2.5 <= by_three.ratio.hi;
    const Comparison comparison = compare_efficiency(a, b);
    ASSERT_TRUE(comparison.known);
    covered += comparison.ratio.lo <= 2.5 && 2.5 <= comparison.ratio.hi;
    found += comparison.p < 0.05;
    logs.add(std::log(comparison.ratio.value));
  }
  EXPECT_GT(covered, 273);
  EXPECT_GT(covered_by_three, 273);
  EXPECT_EQ(found, 300);
  expect_mean(logs, std::log(2.5), 1e-6);
}

// A hundred comparisons of a method with itself: at 5 % each, 13 or more differ with probability 0.0015.
TEST(Resampling, EqualMethodsDifferAtTheStatedRateOnly) {
  int differ = 0;
  for (uint64_t i = 0; i < 100; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 2), i);
    const Repetitions a = noisy(1.0, 30, 10, rng), b = noisy(1.0, 30, 10, rng);
    differ += compare_efficiency(a, b).p < 0.05;
  }
  EXPECT_LT(differ, 13);
  Rng rng(1, rng_stream(RngUse::test, 2), 100);
  const Repetitions same = noisy(1.0, 30, 10, rng);
  const Comparison comparison = compare_efficiency(same, same);
  EXPECT_EQ(comparison.ratio.value, 1.0);
  EXPECT_EQ(comparison.p, 1.0);
}

TEST(Resampling, NothingIsSaidWhereTheReferenceIsTooNoisy) {
  const auto repetitions = [](const std::vector<double>& errors) {
    return Repetitions{mean_of(errors), std::vector<double>(errors.size(), 1.0)};
  };
  const Repetitions good = repetitions({1.0, 1.1, 0.9, 1.0}), none = repetitions({0.0, 0.0, 0.0, 0.0});
  const Repetitions lost = repetitions({0.1, -0.2, -0.1, 0.1});  // less than the reference's own noise
  const Repetitions at_times = repetitions({0.1, -0.05, 0.1, 0.1}), seldom = repetitions({-0.1, 0.8, 1.0, 0.9, 1.1});
  const Repetitions rough = repetitions({0.1, 0.1, 3.0, 0.1});  // the interval of the mean reaches 0, which it is not
  for (const Repetitions& bad : {lost, none, at_times}) {
    EXPECT_FALSE(compare_efficiency(bad, good).known);
    EXPECT_FALSE(compare_efficiency(good, bad).known);
    EXPECT_TRUE(std::isnan(compare_efficiency(good, bad).ratio.lo));
  }
  EXPECT_TRUE(compare_efficiency(seldom, repetitions({1.0, 1.0, 1.0, 1.0, 2.0})).known);
  EXPECT_TRUE(compare_efficiency(rough, good).known);
}

TEST(Resampling, CorrectsForManyAsHolmDoes) {
  std::vector<Comparison> comparisons(4);
  const double p[] = {0.04, 0.01, 0.03, 0.2};
  for (size_t i = 0; i < 4; ++i) {
    comparisons[i].p = p[i];
    comparisons[i].known = i < 3;
  }
  correct_for_many(comparisons);
  EXPECT_DOUBLE_EQ(comparisons[1].p_holm, 0.03);
  EXPECT_DOUBLE_EQ(comparisons[2].p_holm, 0.06);
  EXPECT_DOUBLE_EQ(comparisons[0].p_holm, 0.06);  // never below that of a smaller p
}

// Pairs of unlike spreads, that have nothing in common or most: the interval holds the truth as often as it says.
TEST(Resampling, RelativeDifferencesHoldTheTruth) {
  int covered = 0, covered_pairs = 0, seen = 0;
  constexpr int kTrials = 400;
  Moments apart, paired;  // widths of intervals
  for (uint64_t trial = 0; trial < kTrials; ++trial) {
    Rng rng(1, rng_stream(RngUse::test, 4), trial);
    std::vector<double> a, b, like_a;
    for (int i = 0; i < 6; ++i) {
      a.push_back(2.2 + 0.1 * normal(rng));
      b.push_back(2.0 + 0.04 * normal(rng));
      like_a.push_back(a.back() / 1.1 + 0.005 * normal(rng));
    }
    const Tested difference = relative_difference(a, b), of_pairs = relative_difference(a, like_a);
    const auto holds = [](const ConfidenceInterval& bound, double truth) {
      return bound.lo <= truth && truth <= bound.hi;
    };
    covered += holds(difference.value, 0.1);
    covered_pairs += holds(of_pairs.value, 0.1);
    seen += difference.p < 0.05;
    EXPECT_EQ(difference.p < 0.05, !holds(difference.value, 0.0));
    apart.add(difference.value.hi - difference.value.lo);
    paired.add(of_pairs.value.hi - of_pairs.value.lo);
  }
  EXPECT_GT(covered, 365);  // of 95 %: 365 or fewer with probability 0.001
  EXPECT_GT(covered_pairs, 365);
  EXPECT_LT(paired.mean(), 0.1 * apart.mean());  // without pairs it would be wider than `apart`
  EXPECT_GT(seen, 300);
  EXPECT_EQ(relative_difference({2.0, 2.0}, {1.0, 1.0}).value.value, 1.0);
  EXPECT_EQ(relative_difference({2.0, 2.0}, {1.0, 1.0}).p, 0.0);
  EXPECT_EQ(relative_difference({2.0, 2.0}, {2.0, 2.0}).p, 1.0);
}

TEST(Resampling, SlopesOfPowersAreExact) {
  std::vector<Repetitions> budgets;
  for (const double cost : {1.0, 2.0, 5.0, 11.0}) {
    const double error = 3.0 * std::pow(cost, -0.8);
    budgets.push_back({mean_of({error, 1.5 * error, 0.5 * error}), {cost, cost, cost}});
  }
  const ConfidenceInterval slope = convergence_slope(budgets);
  EXPECT_NEAR(slope.value, -0.8, 1e-12);
  EXPECT_NEAR(slope.lo, -0.8, 1e-9);
  EXPECT_NEAR(slope.hi, -0.8, 1e-9);
}

}  // namespace
}  // namespace vpm
