// Statistical expectations for tests. Each takes its false-alarm rate: the probability that right code fails it for a
// random seed (seeds are fixed, so a test that passes once always does).
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "vpm/base/rng.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/base/vec.h"
#include "vpm/study/check.h"

namespace vpm {

/// The false-alarm rate of a single comparison, unless a test states its own.
inline constexpr double kFalseAlarms = 1e-6;

/// A uniform number of mean 0 and variance 1.
inline double unit_noise(Rng& rng) { return std::sqrt(12.0) * (rng.uniform_double() - 0.5); }

/// z-test: the mean of the samples is `expected`.
inline void expect_mean(const Moments& samples, double expected, double false_alarm_rate, const char* what = "") {
  const double error = std::sqrt(samples.variance_of_mean());
  const double z = (samples.mean() - expected) / error;
  EXPECT_LT(std::abs(z), normal_quantile(false_alarm_rate))
      << what << ": mean " << samples.mean() << " +- " << error << ", expected " << expected;
}

/// Welch's test of each pair: the means of the samples are the same. Where neither varies they are equal.
inline void expect_same_means(const std::vector<Moments>& a, const std::vector<Moments>& b, double false_alarm_rate,
                              const std::string& what) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i].variance() == 0.0 && b[i].variance() == 0.0) {
      EXPECT_EQ(a[i].mean(), b[i].mean()) << what << ", value " << i;
      continue;
    }
    const Check check = check_same("", a[i], b[i]);
    EXPECT_GE(check.p, false_alarm_rate) << what << ", value " << i << ": " << a[i].mean() << " against " << b[i].mean()
                                         << " +- " << check.error;
  }
}

/// Chi-square test: `counts` are of independent draws with the given probabilities, which sum to 1. Cells that expect
/// fewer than 10 are pooled; a cell of probability 0 must be empty.
inline void expect_distribution(const std::vector<double>& counts, const std::vector<double>& probabilities,
                                double false_alarm_rate, const char* what = "") {
  const Check check = check_distribution(what, counts, probabilities);
  EXPECT_GE(check.p, false_alarm_rate) << what << ": chi-square " << check.value << " for " << check.exact << ", "
                                       << check.note;
}

/// A number of the standard normal distribution.
inline double normal(Rng& rng) {
  const double u = 1.0 - rng.uniform_double(), v = rng.uniform_double();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * kPiD * v);
}

}  // namespace vpm
