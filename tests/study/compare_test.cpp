// What comparisons of methods say, against problems whose answers are known by construction.
#include <gtest/gtest.h>

#include "base/rng.h"
#include "study/compare/summary.h"
#include "study/compare/verdict.h"
#include "support/statistics.h"

namespace vpm {
namespace {

/// A number of the standard normal distribution.
double normal(Rng& rng) {
  const double u = 1.0 - rng.uniform_double(), v = rng.uniform_double();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * kPiD * v);
}

/// Repetitions whose errors are means of squares over so many pixels, of noise of that variance; costs differ by 5 %.
Repetitions noisy(double variance, int pixels, size_t count, Rng& rng) {
  Repetitions all;
  for (size_t i = 0; i < count; ++i) {
    double sum = 0.0;
    for (int p = 0; p < pixels; ++p) sum += std::pow(normal(rng), 2.0);
    all.errors.push_back(variance * sum / pixels);
    all.costs.push_back(1.0 + 0.05 * normal(rng));
  }
  return all;
}

TEST(Resampling, IntervalsOfMeansAreStudents) {
  const Bounded mean = mean_with_interval({1.0, 2.0, 3.0, 4.0, 5.0});
  EXPECT_DOUBLE_EQ(mean.value, 3.0);
  EXPECT_NEAR(mean.hi - 3.0, 2.776445105 * std::sqrt(0.5), 1e-8);  // t at 97.5 %, 4 degrees of freedom
  EXPECT_NEAR(3.0 - mean.lo, mean.hi - 3.0, 1e-12);
}

TEST(Resampling, TheJackknifeOfAMeanIsStudents) {
  const std::vector<double> samples{0.3, 1.7, 0.9, 4.1, 2.2, 0.1};
  const Bounded direct = mean_with_interval(samples);
  const Bounded found = jackknife(samples.size(), [&](const std::vector<double>& weights) {
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

// Ten repetitions each of two estimators, one of which needs 2.5 times the cost for the same error. The intervals cover
// that in about 95 of 100 cases: in at most 273 of 300 with probability 0.003.
TEST(Resampling, RatiosKnownByConstructionLieWithinTheirIntervals) {
  int covered = 0, found = 0;
  Moments logs;
  for (uint64_t i = 0; i < 300; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 1), i);
    const Repetitions a = noisy(1.0, 30, 10, rng), b = noisy(2.5, 30, 10, rng);
    const Comparison comparison = compare_efficiency(a, b);
    ASSERT_TRUE(comparison.known);
    covered += comparison.ratio.lo <= 2.5 && 2.5 <= comparison.ratio.hi;
    found += comparison.p < 0.05;
    logs.add(std::log(comparison.ratio.value));
  }
  EXPECT_GT(covered, 273);
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
  const Repetitions good{{1.0, 1.1, 0.9, 1.0}, {1.0, 1.0, 1.0, 1.0}};
  const Repetitions lost{{0.1, -0.2, -0.1, 0.1}, {1.0, 1.0, 1.0, 1.0}};  // less than the reference's own noise
  const Repetitions at_times{{0.1, -0.05, 0.1, 0.1}, {1.0, 1.0, 1.0, 1.0}};
  EXPECT_FALSE(compare_efficiency(lost, good).known);
  EXPECT_FALSE(compare_efficiency(good, at_times).known);
  EXPECT_TRUE(std::isnan(compare_efficiency(good, at_times).ratio.lo));
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

// Means of samples of unlike sizes and spreads: the interval holds the truth as often as it says.
TEST(Resampling, RelativeDifferencesHoldTheTruth) {
  int covered = 0, seen = 0;
  constexpr int kTrials = 400;
  for (uint64_t trial = 0; trial < kTrials; ++trial) {
    Rng rng(1, rng_stream(RngUse::test, 4), trial);
    std::vector<double> a, b;
    for (int i = 0; i < 5; ++i) a.push_back(2.2 + 0.1 * normal(rng));
    for (int i = 0; i < 9; ++i) b.push_back(2.0 + 0.02 * normal(rng));
    const Tested difference = relative_difference(a, b);
    covered += difference.value.lo <= 0.1 && 0.1 <= difference.value.hi;
    seen += difference.p < 0.05;
    EXPECT_EQ(difference.p < 0.05, !(difference.value.lo <= 0.0 && 0.0 <= difference.value.hi));
  }
  EXPECT_GT(covered, 365);  // of 95 %: 365 or fewer with probability 0.001
  EXPECT_GT(seen, 350);
  EXPECT_EQ(relative_difference({2.0, 2.0}, {1.0, 1.0}).value.value, 1.0);
  EXPECT_EQ(relative_difference({2.0, 2.0}, {1.0, 1.0}).p, 0.0);
  EXPECT_EQ(relative_difference({2.0, 2.0}, {2.0, 2.0}).p, 1.0);
}

TEST(Resampling, SlopesOfPowersAreExact) {
  std::vector<Repetitions> budgets;
  for (const double cost : {1.0, 2.0, 5.0, 11.0}) {
    const double error = 3.0 * std::pow(cost, -0.8);
    budgets.push_back({{error, 1.5 * error, 0.5 * error}, {cost, cost, cost}});
  }
  const Bounded slope = convergence_slope(budgets);
  EXPECT_NEAR(slope.value, -0.8, 1e-12);
  EXPECT_NEAR(slope.lo, -0.8, 1e-9);
  EXPECT_NEAR(slope.hi, -0.8, 1e-9);
}

/// A picture of three grey levels, the truth.
Image truth() {
  Image image(3, 2);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Rgb(0.5f + 0.5f * static_cast<float>(i % 3));
  return image;
}

TEST(PictureErrors, AreLessTheReferencesOwnNoise) {
  const Image exact = truth();
  Image off = exact, variance(3, 2);
  for (Rgb& pixel : off.pixels) pixel += Rgb(0.1f);
  for (Rgb& pixel : variance.pixels) pixel = Rgb(0.004f);
  const PictureErrors errors = picture_errors(off, {exact, variance});
  EXPECT_NEAR(errors.mse, 0.01 - 0.004, 1e-6);
  EXPECT_NEAR(errors.mean_ratio, 1.1, 1e-6);
  EXPECT_NEAR(errors.relative_mse_of_pbrt, 0.006 * (1.0 / 0.2601 + 1.0 / 1.0201 + 1.0 / 2.2801) / 3.0, 1e-6);
  // Of scales value^2 + 0.01: those of 0.5, 1 and 1.5.
  const double scale = (1.0 / 0.26 + 1.0 / 1.01 + 1.0 / 2.26) / 3.0;
  EXPECT_NEAR(errors.relative_mse, 0.006 * scale, 1e-6);
  EXPECT_NEAR(reference_noise({exact, variance}), 0.004 * scale, 1e-6);
}

// Pictures with a bias of a twentieth and noise of a tenth: both are told apart, without bias themselves.
TEST(PictureErrors, TellBiasFromVariance) {
  const Image exact = truth();
  const Reference reference{exact, Image(3, 2)};
  Moments bias, squared, variances, deviations;
  int covered = 0, doubted = 0;
  constexpr int kTrials = 400;
  for (uint64_t trial = 0; trial < kTrials; ++trial) {
    Rng rng(1, rng_stream(RngUse::test, 3), trial);
    std::vector<Image> images(6, exact);
    for (Image& image : images)
      for (Rgb& pixel : image.pixels)
        for (int c = 0; c < 3; ++c) pixel[c] *= static_cast<float>(1.05 + 0.1 * normal(rng));
    const RepeatedErrors errors = repeated_errors(images, reference);
    bias.add(errors.bias.value);
    squared.add(errors.squared_bias.value);
    variances.add(errors.variance);
    for (const double deviation : errors.deviations) deviations.add(deviation);
    covered += errors.bias.lo <= 0.05 && 0.05 <= errors.bias.hi;
    doubted += errors.bias_p < 0.05;
  }
  const double share = (0.25 / 0.26 + 1.0 / 1.01 + 2.25 / 2.26) / 3.0;
  expect_mean(bias, 0.05, 1e-6, "bias");
  expect_mean(squared, 0.05 * 0.05 * share, 1e-6, "squared bias");
  expect_mean(variances, 0.1 * 0.1 * share, 1e-6, "variance");
  EXPECT_NEAR(deviations.mean(), 0.1 * 0.1 * share, 3.3e-4);  // 4.5 standard errors
  EXPECT_GT(doubted, 350);  // a bias of more than four standard errors: seen in nine of ten
  EXPECT_GT(covered, 365);  // of 95 %: 365 or fewer with probability 0.001
}

TEST(SceneSummary, FindsTheBestMethodAndCostsOfEqualErrors) {
  const auto budget = [](double cost, double error) {
    BudgetSummary summary;
    for (const double spread : {0.9, 1.0, 1.1}) {
      RunCost run;
      run.cpu_seconds = cost;
      summary.costs.push_back(run);
      summary.each.push_back({2.0 * spread * error, spread * error, 1.0, cost * spread});
      summary.errors.deviations.push_back(0.5 * spread * error);
    }
    return summary;
  };
  // The second method has the same error at a quarter of the cost.
  const SceneSummary summary = summarise_scene(
      {{budget(1.0, 0.4), budget(4.0, 0.1)}, {budget(1.0, 0.1), budget(4.0, 0.025)}}, CostUnit::seconds, size_t{1});
  EXPECT_EQ(summary.best_by_relative_mse, (std::vector<size_t>{1, 1}));
  EXPECT_NEAR(summary.methods[0].by_relative_mse[1].ratio.value, 0.25, 1e-12);
  EXPECT_EQ(summary.methods[1].by_mse[1].ratio.value, 1.0);
  EXPECT_NEAR(summary.targets[0], 0.1, 1e-12);
  ASSERT_TRUE(summary.methods[0].equal_error[0]);
  EXPECT_NEAR(*summary.methods[0].equal_error[0], 4.0, 1e-9);
  EXPECT_NEAR(*summary.methods[1].equal_error[0], 1.0, 1e-9);
  EXPECT_FALSE(summary.methods[0].equal_error[1]);
  ASSERT_EQ(summary.pairs.size(), 1u);
  EXPECT_NEAR(summary.pairs[0].comparison.ratio.value, 0.25, 1e-12);
  EXPECT_NEAR(summary.methods[0].slope.value, -1.0, 1e-12);
  EXPECT_EQ(summary.best_by_variance, (std::vector<size_t>{1, 1}));
  EXPECT_NEAR(summary.methods[0].by_variance[0].ratio.value, 0.25, 1e-12);
  ASSERT_TRUE(summary.methods[0].own_bias[1]);
  EXPECT_NEAR(summary.methods[0].own_bias[1]->value.value, 0.0, 1e-12);
  EXPECT_FALSE(summary.methods[1].own_bias[1]);
}

TEST(BiasVerdicts, JudgeAllBiasesTogether) {
  std::vector<BiasEvidence> evidence{{BiasVerdict::none_seen, 0.004},
                                     {BiasVerdict::none_seen, 0.0031},
                                     {BiasVerdict::baseline, 0.0},
                                     {BiasVerdict::undetermined, 0.0},
                                     {BiasVerdict::none_seen, 0.5}};
  std::vector<BiasEvidence*> all;
  for (BiasEvidence& one : evidence) all.push_back(&one);
  judge(all);
  const BiasVerdict expected[] = {BiasVerdict::biased, BiasVerdict::biased, BiasVerdict::baseline,
                                  BiasVerdict::undetermined, BiasVerdict::none_seen};
  for (size_t i = 0; i < evidence.size(); ++i) EXPECT_EQ(evidence[i].verdict, expected[i]) << i;
  EXPECT_DOUBLE_EQ(evidence[1].p_holm, 0.0093);
  EXPECT_DOUBLE_EQ(evidence[0].p_holm, 0.0093);  // twice 0.004 is less than three times 0.0031
  evidence = {{BiasVerdict::none_seen, 0.004}, {BiasVerdict::none_seen, 0.0035}, {BiasVerdict::none_seen, 0.5}};
  judge({&evidence[0], &evidence[1], &evidence[2]});
  EXPECT_EQ(evidence[1].verdict, BiasVerdict::none_seen);
}

}  // namespace
}  // namespace vpm
