// The statistics under the ladder: p-values, verdicts on families of checks, seeds.
#include "vpm/study/check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <set>

#include "support/statistics.h"
#include "vpm/base/parallel.h"
#include "vpm/base/rng.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/ladder.h"

namespace vpm {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Rng test_rng(uint64_t index) { return {7, rng_stream(RngUse::test, 0), index}; }

Moments moments_of(std::initializer_list<double> values) {
  Moments m;
  for (const double x : values) m.add(x);
  return m;
}

/// p-values of right code must be uniform: chi-square over ten equal bins.
void expect_uniform_p(const char* what, int checks, const std::function<Check(Rng&)>& check) {
  std::vector<double> counts(10, 0.0);
  for (int i = 0; i < checks; ++i) {
    Rng rng = test_rng(static_cast<uint64_t>(i));
    const double p = check(rng).p;
    ASSERT_TRUE(p >= 0.0 && p <= 1.0) << what;
    ++counts[std::min(static_cast<size_t>(p * 10.0), size_t{9})];
  }
  expect_distribution(counts, std::vector<double>(10, 0.1), kFalseAlarms, what);
}

std::vector<Check> judged(std::vector<Check> checks, double rate = 0.01) {
  judge(checks, rate);
  return checks;
}

TEST(Check, TTestHasItsClosedForm) {
  // t = sqrt(2) with 4 degrees of freedom: p = 1 - (3/4) (2 / sqrt(3)) (8/9).
  const Check check = check_mean("", moments_of({1, 2, 3, 4, 5}), 2.0);
  EXPECT_DOUBLE_EQ(check.error, std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(check.deviation(), std::sqrt(2.0));
  EXPECT_NEAR(check.p, 1.0 - 0.75 * 2.0 / std::sqrt(3.0) * 8.0 / 9.0, 1e-12);
  EXPECT_DOUBLE_EQ(check_mean("", moments_of({1, 2, 3, 4, 5}), 2.0, 0.5).error, std::sqrt(0.75));
}

TEST(Check, WithoutAnyErrorOnlyEqualityPasses) {
  EXPECT_EQ(check_mean("", moments_of({2, 2, 2}), 2.0).p, 1.0);
  EXPECT_EQ(check_mean("", moments_of({2, 2, 2}), 2.0 + 1e-15).p, 0.0);
}

TEST(Check, ValuesAreTestedAsNormal) {
  EXPECT_NEAR(check_value("", 1.0 + 1.959963984540054 * 0.25, 0.25, 1.0).p, 0.05, 1e-12);
}

/// `hits` ones among `trials` samples.
Moments ones(int hits, int trials) {
  Moments m;
  for (int i = 0; i < trials; ++i) m.add(i < hits ? 1.0 : 0.0);
  return m;
}

TEST(Check, RareEventsAreTestedAsPoisson) {
  // None where 3 are expected; 10 or more where 3 are: twice the smaller tail.
  EXPECT_NEAR(check_probability("", ones(0, 100000), 3e-5).p, 2.0 * std::exp(-3.0), 1e-12);
  EXPECT_NEAR(check_probability("", ones(10, 100000), 3e-5).p, 2.0 * 0.0011024881, 1e-9);
  EXPECT_NEAR(check_probability("", ones(99990, 100000), 1.0 - 3e-5).p, 2.0 * 0.0011024881, 1e-9);
  EXPECT_EQ(check_probability("", ones(0, 1000), 0.0).p, 1.0);
  EXPECT_EQ(check_probability("", ones(1, 1000), 0.0).p, 0.0);
  EXPECT_EQ(check_probability("", ones(999, 1000), 1.0).p, 0.0);
}

TEST(Check, FrequentEventsAreTestedAsNormal) {
  const Check check = check_probability("", ones(5100, 10000), 0.5);
  EXPECT_DOUBLE_EQ(check.error, 0.005);
  EXPECT_NEAR(check.deviation(), 2.0, 1e-12);
  EXPECT_NEAR(check.p, normal_tail(2.0), 1e-12);
}

TEST(Check, TwoMeansAreTestedWithWelchsDegreesOfFreedom) {
  // Variances of the means 5/12 and 4/3.
  const Check check = check_same("", moments_of({1, 2, 3, 4}), moments_of({2, 4, 6}));
  const double a = 5.0 / 12.0, b = 4.0 / 3.0;
  EXPECT_DOUBLE_EQ(check.deviation(), -1.5 / std::sqrt(a + b));
  EXPECT_DOUBLE_EQ(check.p, student_tail(1.5 / std::sqrt(a + b), (a + b) * (a + b) / (a * a / 3.0 + b * b / 2.0)));
}

TEST(Check, PValuesOfRightCodeAreUniform) {
  expect_uniform_p("check_mean", 5000, [](Rng& rng) {
    Moments m;
    for (int i = 0; i < 4; ++i) m.add(3.0 + 2.0 * normal(rng));
    return check_mean("", m, 3.0);
  });
  expect_uniform_p("check_same", 5000, [](Rng& rng) {
    Moments a, b;
    for (int i = 0; i < 10; ++i) a.add(normal(rng));
    for (int i = 0; i < 20; ++i) b.add(0.5 * normal(rng));
    return check_same("", a, b);
  });
  expect_uniform_p("check_distribution", 2000, [](Rng& rng) {
    std::vector<double> counts(8, 0.0);
    for (int i = 0; i < 4000; ++i) ++counts[static_cast<size_t>(rng.uniform() * 8.0f)];
    return check_distribution("", counts, std::vector<double>(8, 0.125));
  });
}

/// Draws of weight `weight(cell)` that fall into one of four cells with probability 0.3, 0.2, 0.1 or into none.
std::vector<Moments> draws_in_cells(int draws, Rng& rng, const std::function<double(size_t)>& weight) {
  std::vector<Moments> cells(3);
  for (int i = 0; i < draws; ++i) {
    const float u = rng.uniform();
    const size_t hit = u < 0.3f ? 0 : u < 0.5f ? 1 : u < 0.6f ? 2 : 3;
    for (size_t c = 0; c < 3; ++c) cells[c].add(c == hit ? weight(c) : 0.0);
  }
  return cells;
}

TEST(Check, WeightsInCellsHaveUniformPValues) {
  expect_uniform_p("weights that vary", 1000, [](Rng& rng) {
    return check_weights("", draws_in_cells(4000, rng, [&](size_t c) { return (c + 1.0) * 2.0 * rng.uniform(); }),
                         {0.3, 0.4, 0.3});
  });
  expect_uniform_p("equal weights", 1000, [](Rng& rng) {
    std::vector<Moments> cells(4);
    for (int i = 0; i < 4000; ++i) {
      const float u = rng.uniform();
      const size_t hit = u < 0.3f ? 0 : u < 0.5f ? 1 : u < 0.6f ? 2 : 3;
      for (size_t c = 0; c < 4; ++c) cells[c].add(c == hit ? 1.0 : 0.0);
    }
    const Check check = check_weights("", cells, {0.3, 0.2, 0.1, 0.4});
    EXPECT_EQ(check.exact, 3.0);
    return check;
  });
}

TEST(Check, WrongWeightsInCellsAreSeen) {
  Rng rng = test_rng(1);
  const auto draws = [&](const std::function<double(size_t)>& weight) { return draws_in_cells(40000, rng, weight); };
  const std::vector<double> means{0.3, 0.2, 0.1};
  EXPECT_GT(check_weights("", draws([](size_t) { return 1.0; }), means).p, 1e-4);
  EXPECT_LT(check_weights("", draws([](size_t) { return 1.1; }), means).p, 1e-6) << "too heavy";
  EXPECT_LT(check_weights("", draws([](size_t c) { return c == 2 ? 1.2 : 1.0; }), means).p, 1e-6) << "one cell";
  EXPECT_EQ(check_weights("", draws([](size_t c) { return c == 2 ? 0.0 : 1.0; }), means).p, 0.0) << "a cell never hit";
  EXPECT_GT(check_weights("", draws([](size_t c) { return c == 2 ? 1.2 : 1.0; }), means, {0.0, 0.0, 0.02}).p, 1e-4)
      << "an error of the reference that explains it";

  std::vector<Moments> all(2);
  for (int i = 0; i < 4000; ++i)
    for (size_t c = 0; c < 2; ++c) all[c].add((i % 2 == 0) == (c == 0) ? 1.001 : 0.0);
  EXPECT_EQ(check_weights("", all, {0.5, 0.5}).p, 0.0) << "equal weights that are not 1";
}

TEST(Check, HeavyTailsAreNotDetermined) {
  Moments rare;
  for (int i = 0; i < 100'000; ++i) rare.add(i % 1000 == 0 ? 1000.0 : 0.0);
  EXPECT_NEAR(effective_sample_size(rare), 100.0, 1e-9);
  const Check mean = check_weighted_mean("", rare, 1.0);
  EXPECT_EQ(mean.kind, CheckKind::undetermined);
  EXPECT_NE(mean.note.find("100"), std::string::npos) << mean.note;
  EXPECT_EQ(check_weights("", {rare, rare}, {1.0, 1.0}).kind, CheckKind::undetermined);
  EXPECT_EQ(judged({mean})[0].verdict, Verdict::undetermined);
  EXPECT_EQ(effective_sample_size(moments_of({0, 0})), 0.0);
  EXPECT_DOUBLE_EQ(effective_sample_size(moments_of({3, 3, 3})), 3.0);
}

TEST(Check, ACellOfProbabilityZeroMustStayEmpty) {
  EXPECT_EQ(check_distribution("", {50, 49, 1}, {0.5, 0.5, 0.0}).p, 0.0);
  EXPECT_GT(check_distribution("", {50, 50, 0}, {0.5, 0.5, 0.0}).p, 0.5);
}

TEST(Check, BoundsHoldAlways) {
  const auto checks = judged({check_bound("", 1.5, 1.0, 0.5), check_bound("", 1.5001, 1.0, 0.5),
                              check_bound("", kNaN, 1.0, 0.5), check_bound("", 1.0, 1.0, 0.0)});
  EXPECT_EQ(checks[0].verdict, Verdict::pass);
  EXPECT_EQ(checks[1].verdict, Verdict::fail);
  EXPECT_EQ(checks[2].verdict, Verdict::fail);
  EXPECT_EQ(checks[3].verdict, Verdict::pass);
  EXPECT_EQ(checks[3].deviation(), 0.0);
}

TEST(Check, WithinABoundOnlyWhatIsBeyondItCounts) {
  const Moments samples = moments_of({1.9, 2.0, 2.1, 2.0}), even = moments_of({2.0, 2.0, 2.0});
  const auto checks = judged({check_within("", samples, 1.0, 1.0), check_within("", samples, 3.0, 1.01),
                              check_within("", samples, 1.0, 0.5), check_within("", even, 1.0, 1.0),
                              check_within("", even, 1.0, 0.999)});
  EXPECT_EQ(checks[0].p, 1.0);
  EXPECT_EQ(checks[1].p, 1.0);
  EXPECT_NEAR(checks[2].p, check_mean("", samples, 1.5).p, 1e-12);
  EXPECT_EQ(checks[3].verdict, Verdict::pass);
  EXPECT_EQ(checks[4].verdict, Verdict::fail);
}

TEST(Check, WhatIsNotANumberFails) {
  const auto checks =
      judged({check_mean("", moments_of({1.0, kNaN, 2.0}), 1.0), check_value("", kNaN, 1.0, 0.0),
              check_value("", 0.0, kNaN, 0.0), check_same("", moments_of({1.0, 2.0}), moments_of({1.0, kNaN})),
              check_distribution("", {kNaN, 50.0}, {0.5, 0.5}),
              check_weights("", {moments_of({1, kNaN}), moments_of({0, 0})}, {0.5, 0.5}),
              check_weighted_mean("", moments_of({1.0, kNaN}), 1.0),
              check_within("", moments_of({1.0, kNaN, 2.0}), 1.0, 0.5)});
  for (size_t i = 0; i < checks.size(); ++i) EXPECT_EQ(checks[i].verdict, Verdict::fail) << i;
}

TEST(Judge, AFamilyOfRightChecksFailsAtTheStatedRate) {
  constexpr int kFamilies = 10'000, kChecks = 20;
  constexpr double kRate = 0.1;
  Moments failed;
  for (int i = 0; i < kFamilies; ++i) {
    Rng rng = test_rng(static_cast<uint64_t>(i));
    std::vector<Check> checks;
    for (int k = 0; k < kChecks; ++k) checks.push_back(check_value("", normal(rng), 1.0, 0.0));
    checks.push_back(check_bound("", 0.0, 0.0, 1.0));  // these do not count
    checks.push_back(not_determined("", 0.0, 1.0, ""));
    EXPECT_NEAR(judge(checks, kRate), 1.0 - std::pow(1.0 - kRate, 1.0 / kChecks), 1e-15);
    bool any = false;
    for (const Check& check : checks) any |= check.verdict == Verdict::fail;
    failed.add(any ? 1.0 : 0.0);
  }
  expect_mean(failed, kRate, kFalseAlarms);
}

TEST(SampleMoments, DoNotDependOnHowTheWorkIsCut) {
  const auto sample = [](Rng& rng, double* out) {
    out[0] += rng.uniform_double();
    if (out[0] > 0.5) out[1] = 1.0;
  };
  set_threads(1);
  const auto one = sample_moments(2, 10'000, 3, sample);
  set_threads(4);
  const auto four = sample_moments(2, 10'000, 3, sample);
  set_threads(0);
  for (size_t q = 0; q < 2; ++q) {
    EXPECT_EQ(one[q].count(), 10'000u);
    EXPECT_EQ(one[q].mean(), four[q].mean());
    EXPECT_EQ(one[q].variance(), four[q].variance());
    expect_mean(one[q], 0.5, kFalseAlarms);
  }
  EXPECT_NE(sample_moments(2, 10'000, 4, sample)[0].mean(), one[0].mean());
}

TEST(Effort, SeedsDifferBetweenNamesAndRuns) {
  const Effort a{1, false}, b{2, false};
  std::set<uint64_t> seeds;
  const std::vector<std::string> names{"", "a", "b", "ab", "ba", "aa", "abc", "a b", std::string("a\0", 2)};
  for (const std::string& name : names) {
    EXPECT_EQ(a.seed_of(name), a.seed_of(name));
    seeds.insert(a.seed_of(name));
    seeds.insert(b.seed_of(name));
  }
  EXPECT_EQ(seeds.size(), 2 * names.size());
  EXPECT_EQ(a.seed_of("x"), (Effort{1, true}.seed_of("x")));
}

TEST(Ladder, GroupsHaveTheirLevelAndANameOfTheirOwn) {
  std::set<std::string> names;
  size_t count = 0;
  for (int level = 0; level < kLevels; ++level)
    for (const Experiment& experiment : experiments(level)) {
      EXPECT_EQ(experiment.level, level);
      names.insert(experiment.name);
      ++count;
    }
  EXPECT_EQ(names.size(), count);
  EXPECT_EQ(experiments(-1).size(), count);
}

}  // namespace
}  // namespace vpm
