// Confidence from repetitions: intervals by jackknife and Student's t, and what differences are significant among many.
#pragma once

#include <functional>
#include <vector>

#include "vpm/study/compare/errors.h"

namespace vpm {

/// An estimate with the probability of one so far from 0, were the truth 0.
struct Tested {
  ConfidenceInterval value;
  double p = 1.0;
};
/// The mean of independent samples (at least 2) of which a number has been subtracted that has itself this standard
/// error: by Student's t, its degrees of freedom by [Welch1947].
Tested mean_beside(const std::vector<double>& samples, double error);
/// The mean of independent samples (at least 2) with its interval [Student1908].
ConfidenceInterval mean_with_interval(const std::vector<double>& samples);

/// The mean of `a` over that of `b`, less 1, from samples (at least 2) that are paired by number, and whose means are
/// not near 0: by the delete-one jackknife over pairs [Tukey1958].
Tested relative_difference(const std::vector<double>& a, const std::vector<double>& b);

/// A statistic of repetitions, computed from weights of these.
using Statistic = std::function<double(const std::vector<double>& weights)>;
Statistic mean_of(std::vector<double> samples);
/// Without bias, from distances[i][j], j < i, the squared difference of two repetitions: half its mean over pairs. A
/// repetition has no distance to itself. NaN of one alone.
Statistic variance_of(std::vector<std::vector<double>> distances);

/// With its interval by the delete-one jackknife [Tukey1958], of `count` >= 3 repetitions.
ConfidenceInterval jackknife(size_t count, const Statistic& statistic);

/// How much better one method did than another over paired repetitions.
struct Comparison {
  ConfidenceInterval ratio;  // of efficiencies 1/(error cost): the first's over the second's; bounds NaN where unknown
  double p = 1.0;            // of a ratio so far from 1, were they equal
  double p_holm = 1.0;       // the same, corrected for all comparisons made together [Holm1979]
  bool known = false;        // false: an error is 0, or hidden by the reference's noise
};

/// Repetitions of one method; two of them are paired by number.
struct Repetitions {
  Statistic error;  // what the error is of those that are taken
  std::vector<double> costs;
};
double mean_error(const Repetitions& of);
double mean_cost(const Repetitions& of);

/// Efficiencies are those of the mean error and the mean cost. Interval and p are those of the ratio's logarithm, by
/// the jackknife [Miller1968] over pairs of repetitions. Of pictures of 1, 30 and 300 independent normal pixels the
/// intervals of 3, 5 and 10 repetitions hold a true ratio of variances in 94 to 98 % of cases, one of relative MSEs in
/// 92 to 96 %.
Comparison compare_efficiency(const Repetitions& a, const Repetitions& b);

/// p-values corrected for being tested together: that any of them falls below a rate by chance has no more than that
/// probability [Holm1979].
std::vector<double> corrected_for_many(const std::vector<double>& p);
/// Fills in p_holm of those that are known.
void correct_for_many(std::vector<Comparison>& comparisons);

/// The slope of log(error) over log(cost), of means over repetitions at several budgets (at least 2). Least squares;
/// NaN where an error is not above 0 or all costs are the same.
ConfidenceInterval convergence_slope(const std::vector<Repetitions>& budgets);

}  // namespace vpm
