// What comparisons of methods say, against problems whose answers are known by construction.
#include <gtest/gtest.h>

#include "support/statistics.h"
#include "vpm/study/compare/summary.h"

namespace vpm {
namespace {

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

/// Pictures of so many grey pixels around 1, whose noise is independent and of that variance.
std::vector<Image> noisy_pictures(size_t count, int pixels, double variance, Rng& rng) {
  std::vector<Image> images(count, Image(pixels, 1));
  for (Image& image : images)
    for (Rgb& pixel : image.pixels) pixel = Rgb(static_cast<float>(1.0 + std::sqrt(variance) * normal(rng)));
  return images;
}

/// A truth of grey pixels of radiance 1, that is exact.
Reference even_reference(int pixels) {
  Reference reference{Image(pixels, 1), Image(pixels, 1)};
  for (Rgb& pixel : reference.mean.pixels) pixel = Rgb(1.0f);
  return reference;
}

/// In how many of 400 trials the interval holds the ratio of efficiencies by variance, which is 2.5.
int held_ratios_of_variances(int pixels, size_t count) {
  const Reference reference = even_reference(pixels);
  int held = 0;
  for (uint64_t trial = 0; trial < 400; ++trial) {
    Rng rng(1, rng_stream(RngUse::test, 5), trial);
    const auto repetitions = [&](double variance) {
      const RepeatedErrors errors = repeated_errors(noisy_pictures(count, pixels, variance, rng), reference);
      Repetitions all{variance_of(errors.distances), {}};
      for (size_t i = 0; i < count; ++i) all.costs.push_back(1.0 + 0.05 * normal(rng));
      return all;
    };
    const Repetitions a = repetitions(0.01), b = repetitions(0.025);
    const Comparison comparison = compare_efficiency(a, b);
    held += comparison.known && comparison.ratio.lo <= 2.5 && 2.5 <= comparison.ratio.hi;
  }
  return held;
}

// However few pixels and repetitions there are. Of 95 %, 365 or fewer come with probability 0.001; each.
TEST(PictureErrors, RatiosOfVariancesLieWithinTheirIntervals) {
  for (const int pixels : {1, 30, 300})
    for (const size_t count : {3, 5, 10})
      EXPECT_GT(held_ratios_of_variances(pixels, count), 365) << pixels << " pixels, " << count << " repetitions";
}

TEST(PictureErrors, DeviationsAreFromTheMeanOfAll) {
  const Reference reference = even_reference(1);
  std::vector<Image> images(3, Image(1, 1));
  for (size_t i = 0; i < 3; ++i) images[i].pixels[0] = Rgb(i == 2 ? 4.0f : 1.0f);
  const RepeatedErrors errors = repeated_errors(images, reference);
  const double scale = 1.01;
  EXPECT_NEAR(errors.distances[2][1], 9.0 / scale, 1e-12);
  EXPECT_NEAR(errors.deviations[0], 1.5 * 1.0 / scale, 1e-12);
  EXPECT_NEAR(errors.deviations[2], 1.5 * 4.0 / scale, 1e-12);
  const Statistic variance = variance_of(errors.distances);
  EXPECT_NEAR(variance({1.0, 1.0, 1.0}), 3.0 / scale, 1e-12);
  EXPECT_NEAR(variance({0.0, 1.0, 1.0}), 4.5 / scale, 1e-12);
  EXPECT_EQ(variance({1.0, 1.0, 0.0}), 0.0);
  EXPECT_TRUE(std::isnan(variance({0.0, 0.0, 1.0})));
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
  const auto budget = [](double cost, double error, double variance, double mean_ratio) {
    BudgetSummary summary;
    for (const double spread : {0.9, 1.0, 1.1}) {
      RunCost run;
      run.cpu_seconds = cost;
      summary.costs.push_back(run);
      summary.each.push_back({2.0 * spread * error, spread * error, 1.0, mean_ratio * spread});
    }
    summary.errors.distances = {{}, {1.8 * variance}, {2.0 * variance, 2.2 * variance}};
    return summary;
  };
  // The second method has the same error at a quarter of the cost, at three times the variance.
  const SceneSummary summary = summarise_scene({{budget(1.0, 0.4, 0.02, 1.1), budget(4.0, 0.1, 0.005, 1.2)},
                                                {budget(1.0, 0.1, 0.06, 1.0), budget(4.0, 0.025, 0.015, 1.0)}},
                                               CostUnit::seconds, size_t{1});
  EXPECT_EQ(summary.best_by_relative_mse, (std::vector<size_t>{1, 1}));
  EXPECT_EQ(summary.best_by_mse, (std::vector<size_t>{1, 1}));
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
  EXPECT_EQ(summary.best_by_variance, (std::vector<size_t>{0, 0}));
  EXPECT_NEAR(summary.methods[1].by_variance[0].ratio.value, 1.0 / 3.0, 1e-12);
  EXPECT_EQ(summary.methods[0].by_variance[1].ratio.value, 1.0);
  ASSERT_TRUE(summary.methods[0].own_bias[1]);
  EXPECT_NEAR(summary.methods[0].own_bias[0]->value.value, 0.1, 1e-12);
  EXPECT_NEAR(summary.methods[0].own_bias[1]->value.value, 0.2, 1e-12);
  EXPECT_FALSE(summary.methods[1].own_bias[1]);
}

/// How many p-values fell below 5 %.
struct FalseAlarms {
  int of_bias = 0, of_own_bias = 0;
};

/// A thousand scenes of 20 pixels, where two methods without bias meet a reference whose noise moves its brightness by
/// as much as theirs moves their means'. The second's noise is half the first's.
FalseAlarms false_alarms() {
  constexpr int kPixels = 20;
  constexpr size_t kRepetitions = 10;
  FalseAlarms found;
  for (uint64_t trial = 0; trial < 1000; ++trial) {
    Rng rng(1, rng_stream(RngUse::test, 6), trial);
    Reference reference{noisy_pictures(1, kPixels, 0.001, rng)[0], Image(kPixels, 1)};
    for (Rgb& pixel : reference.variance.pixels) pixel = Rgb(0.001f);
    const std::vector<Image> first = noisy_pictures(kRepetitions, kPixels, 0.01, rng);
    std::vector<Image> second = noisy_pictures(kRepetitions, kPixels, 0.0025, rng);
    for (size_t i = 0; i < kRepetitions; ++i)
      for (size_t p = 0; p < kPixels; ++p) second[i].pixels[p] += 0.5f * (first[i].pixels[p] - 1.0f);
    const std::vector<RunCost> costs(kRepetitions, RunCost{1.0});
    const std::vector<std::vector<BudgetSummary>> budgets{{summarise_budget(costs, first, reference)},
                                                          {summarise_budget(costs, second, reference)}};
    const auto alarm = [&](std::optional<size_t> baseline) {
      const SceneSummary summary = summarise_scene(budgets, CostUnit::seconds, baseline);
      return bias_evidence(budgets, summary, baseline, reference)[0].p < 0.05;
    };
    found.of_bias += alarm(std::nullopt);
    found.of_own_bias += alarm(1);
  }
  return found;
}

// Of 5 %, 29 or fewer of a thousand come with probability 0.0007, 73 or more with 0.001; each.
TEST(BiasVerdicts, AreWrongAtTheStatedRate) {
  const FalseAlarms found = false_alarms();
  EXPECT_GT(found.of_bias, 29);
  EXPECT_LT(found.of_bias, 73);
  EXPECT_GT(found.of_own_bias, 29);
  EXPECT_LT(found.of_own_bias, 73);
}

/// Three methods at one budget, with p-values of their biases, and of those beside a baseline.
struct ThreeMethods {
  std::vector<std::vector<BudgetSummary>> budgets{3, std::vector<BudgetSummary>(1)};
  SceneSummary summary;

  explicit ThreeMethods(std::optional<size_t> baseline) {
    summary.methods.resize(3);
    for (size_t m = 0; m < 3; ++m) {
      budgets[m][0].errors.bias_p = 0.1 * static_cast<double>(m + 1);
      const double own_p = 0.01 * static_cast<double>(m + 1);
      summary.methods[m].own_bias = {baseline && *baseline != m ? std::optional(Tested{{}, own_p}) : std::nullopt};
    }
  }
};

TEST(BiasVerdicts, KnowNothingBesideABaselineInDoubt) {
  const Reference reference;
  ThreeMethods methods(1);
  std::vector<BiasEvidence> evidence = bias_evidence(methods.budgets, methods.summary, 1, reference);
  EXPECT_TRUE(is_judged(evidence[0]));
  EXPECT_EQ(evidence[0].p, 0.01);
  EXPECT_EQ(evidence[1].verdict, BiasVerdict::baseline);
  EXPECT_FALSE(is_judged(evidence[1]));
  methods.budgets[2][0].why_bias_unknown = "effective sample size 7 < 1000";
  evidence = bias_evidence(methods.budgets, methods.summary, 1, reference);
  EXPECT_TRUE(is_judged(evidence[0]));
  EXPECT_EQ(evidence[2].verdict, BiasVerdict::undetermined);
  EXPECT_EQ(evidence[2].why, "effective sample size 7 < 1000");
  methods.budgets[1][0].why_bias_unknown = "effective sample size 4.2 < 1000";
  evidence = bias_evidence(methods.budgets, methods.summary, 1, reference);
  EXPECT_EQ(evidence[0].verdict, BiasVerdict::undetermined);
  EXPECT_EQ(evidence[0].why, "the baseline's effective sample size 4.2 < 1000");
  EXPECT_EQ(evidence[1].verdict, BiasVerdict::baseline);
  EXPECT_EQ(evidence[2].why, "effective sample size 7 < 1000");
}

TEST(BiasVerdicts, KnowNothingBesideAReferenceInDoubt) {
  Reference reference;
  const ThreeMethods alone(std::nullopt), beside(0);
  EXPECT_EQ(bias_evidence(alone.budgets, alone.summary, std::nullopt, reference)[2].p,
            alone.budgets[2][0].errors.bias_p);
  reference.doubt = "it is odd";
  for (const BiasEvidence& one : bias_evidence(alone.budgets, alone.summary, std::nullopt, reference)) {
    EXPECT_EQ(one.verdict, BiasVerdict::undetermined);
    EXPECT_EQ(one.why, "it is odd");
  }
  EXPECT_TRUE(is_judged(bias_evidence(beside.budgets, beside.summary, 0, reference)[2]));
}

TEST(BiasVerdicts, KnowNothingOfWhatIsNoNumber) {
  ThreeMethods methods(std::nullopt);
  methods.budgets[1][0].errors.bias_p = std::numeric_limits<double>::quiet_NaN();
  const std::vector<BiasEvidence> evidence = bias_evidence(methods.budgets, methods.summary, std::nullopt, Reference());
  EXPECT_TRUE(is_judged(evidence[0]));
  EXPECT_EQ(evidence[1].verdict, BiasVerdict::undetermined);
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
