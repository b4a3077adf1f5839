// Statistical expectations for tests. Each takes its false-alarm rate: the probability that right code fails it for a
// random seed (seeds are fixed, so a test that passes once always does).
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/statistics.h"

namespace vpm {

/// z-test: the mean of the samples is `expected`.
inline void expect_mean(const Moments& samples, double expected, double false_alarm_rate, const char* what = "") {
  const double error = std::sqrt(samples.variance_of_mean());
  const double z = (samples.mean() - expected) / error;
  EXPECT_LT(std::abs(z), normal_quantile(false_alarm_rate))
      << what << ": mean " << samples.mean() << " +- " << error << ", expected " << expected;
}

/// Chi-square test: `counts` are of independent draws with the given probabilities, which sum to 1. Cells that expect
/// fewer than 10 are pooled; a cell of probability 0 must be empty.
inline void expect_distribution(const std::vector<double>& counts, const std::vector<double>& probabilities,
                                double false_alarm_rate, const char* what = "") {
  ASSERT_EQ(counts.size(), probabilities.size());
  double draws = 0.0;
  for (const double c : counts) draws += c;
  double statistic = 0.0, pooled_count = 0.0, pooled_expected = 0.0;
  int cells = 0;
  const auto add_cell = [&](double count, double expected) {
    statistic += (count - expected) * (count - expected) / expected;
    ++cells;
  };
  for (size_t i = 0; i < counts.size(); ++i) {
    const double expected = draws * probabilities[i];
    if (expected >= 10.0) {
      add_cell(counts[i], expected);
    } else {
      EXPECT_TRUE(expected > 0.0 || counts[i] == 0.0) << what << ": cell " << i << " must be empty";
      pooled_count += counts[i];
      pooled_expected += expected;
    }
  }
  if (pooled_expected > 0.0) add_cell(pooled_count, pooled_expected);
  ASSERT_GT(cells, 1) << what;
  EXPECT_GT(chi2_tail(statistic, cells - 1), false_alarm_rate)
      << what << ": chi-square " << statistic << " over " << cells << " cells";
}

}  // namespace vpm
