// Confidence from repetitions: intervals by jackknife and Student's t, ratios by studentised bootstrap, and what
// differences are significant among many.
#pragma once

#include <functional>
#include <vector>

#include "study/compare/errors.h"

namespace vpm {

/// The mean of independent samples (at least 2) with its interval [Student1908].
Bounded mean_with_interval(const std::vector<double>& samples);

/// An estimate with the probability of one so far from 0, were the truth 0.
struct Tested {
  Bounded value;
  double p = 1.0;
};
/// The mean of `a` over that of `b`, less 1, from independent samples of each (at least 2) whose means are not near 0:
/// to first order in their errors, by Welch's t [Welch1947].
Tested relative_difference(const std::vector<double>& a, const std::vector<double>& b);

/// A statistic of `count` >= 3 repetitions, computed from weights of these (how often each is taken), with its interval
/// by the delete-one jackknife [Tukey1958].
using Statistic = std::function<double(const std::vector<double>& weights)>;
Bounded jackknife(size_t count, const Statistic& statistic);

/// How much better one method did than another over paired repetitions.
struct Comparison {
  Bounded ratio;        // of efficiencies 1/(error cost): the first's over the second's; bounds NaN where unknown
  double p = 1.0;       // of a ratio so far from 1, were they equal
  double p_holm = 1.0;  // the same, corrected for all comparisons made together [Holm1979]
  bool known = false;   // false: a mean error is not above 0, of all repetitions or of some of them
};

/// Errors and costs of repetitions of one method; two of them are paired by number.
struct Repetitions {
  std::vector<double> errors, costs;
};

/// Efficiencies are those of the mean error and the mean cost. The interval is the bootstrap's of the studentised
/// logarithm [Efron1993, sec. 12.5], p is the jackknife's by Student's t. A pure function of its arguments.
Comparison compare_efficiency(const Repetitions& a, const Repetitions& b);

/// p-values corrected for being tested together: that any of them falls below a rate by chance has no more than that
/// probability [Holm1979].
std::vector<double> corrected_for_many(const std::vector<double>& p);
/// Fills in p_holm of those that are known.
void correct_for_many(std::vector<Comparison>& comparisons);

/// The slope of log(error) over log(cost), of means over repetitions at several budgets (at least 2): errors and costs
/// by budget. Least squares; NaN where an error is not above 0 or all costs are the same.
Bounded convergence_slope(const std::vector<Repetitions>& budgets);

}  // namespace vpm
