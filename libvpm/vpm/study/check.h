// One comparison of a number with what it must be, and the verdicts on a family of them at one false-alarm rate.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vpm/base/statistics/moments.h"

namespace vpm {

enum class Verdict { pass, fail, undetermined };

/// What decides a check.
enum class CheckKind {
  statistical,  // a p-value
  bounded,      // |value - exact| against a bound that holds always
  undetermined  // nothing: the estimate's error is not known, e.g. at a small effective sample size
};

struct Check {
  CheckKind kind = CheckKind::statistical;
  std::string name;
  double value = 0.0;
  double exact = 0.0;
  double error = 0.0;                       // standard error of value - exact; bounded: the bound
  double p = 1.0;                           // of a difference at least as large by chance; 1 where not statistical
  std::string note;                         // what a reader should know besides
  Verdict verdict = Verdict::undetermined;  // by judge()

  /// value - exact in standard errors; in bounds where bounded. 0 where both are 0.
  double deviation() const { return value == exact ? 0.0 : (value - exact) / error; }
};

/// The mean of independent samples must be `exact`, known to `exact_error` (a standard error, or a bound far below the
/// samples' own). Student's t-test.
Check check_mean(std::string name, const Moments& samples, double exact, double exact_error = 0.0);

/// The mean of independent samples must be `exact`, known to lie within `bound` of it: what is beyond the bound is
/// judged by Student's t-test.
Check check_within(std::string name, const Moments& samples, double exact, double bound);

/// The share of successes among independent trials (samples that are 1 or 0) must be `probability`. The error is that
/// of the binomial distribution; where fewer than 1000 successes or failures are expected, the p-value is the Poisson
/// distribution's, so that rare events are judged rightly, too.
Check check_probability(std::string name, const Moments& zeros_and_ones, double probability);

/// A value with an approximately normal error of that standard error.
Check check_value(std::string name, double value, double standard_error, double exact);

/// Two means of independent samples must agree: Welch's t-test [Welch1947].
Check check_same(std::string name, const Moments& a, const Moments& b);

/// Counts of independent draws must have the given probabilities, which sum to 1: chi-square, cells that expect fewer
/// than 10 pooled. `value` is the statistic, `exact` its mean (the degrees of freedom).
Check check_distribution(std::string name, const std::vector<double>& counts, const std::vector<double>& probabilities);

/// Of the samples as weights.
double effective_sample_size(const Moments& samples);

/// Below that effective sample size heavy tails may hide from a sample: nothing is said of its mean.
inline constexpr double kLeastSampleSize = 1000.0;

/// check_mean() of weights that may have heavy tails: not determined below kLeastSampleSize.
Check check_weighted_mean(std::string name, const Moments& samples, double exact);

/// Independent weighted draws, each of which adds its weight to one of the cells, must have the given mean weights in
/// them, each known to `errors`, if given: Hotelling's test [Hotelling1931]. Its statistic is chi-square with a degree
/// of freedom for each cell, one less where the weights are all equal. Not determined where the effective sample size
/// of all weights is below kLeastSampleSize, or below 50 in a cell. `value` and `exact` as in check_distribution().
Check check_weights(std::string name, const std::vector<Moments>& cells, const std::vector<double>& means,
                    const std::vector<double>& errors = {});

/// `value` must lie within `bound` of `exact`, always.
Check check_bound(std::string name, double value, double exact, double bound);

/// An estimate of which nothing can be said, and why.
Check not_determined(std::string name, double value, double exact, std::string why);

/// Gives every check its verdict. All statistical ones together fail by chance with probability `rate`: each fails
/// where its p-value is below 1 - (1 - rate)^(1/n) [Sidak1967], for the n of them. Returns that threshold. A p-value
/// that is NaN fails.
double judge(std::vector<Check>& checks, double rate);

}  // namespace vpm
