// Tails of the distributions that tests of hypotheses ask for, and the places where tails have a given probability.
#pragma once

namespace vpm {

/// Probability that a standard normal variable lies further from 0 than `z` (either side): the p-value of a z-test.
double normal_tail(double z);

/// The z >= 0 with normal_tail(z) = p, for 0 < p <= 1: the threshold of a z-test with false-alarm rate p.
double normal_quantile(double p);

/// Probability that a chi-square variable with `dof` > 0 degrees of freedom exceeds `statistic` >= 0: the p-value of a
/// chi-square test. NaN of NaN, so test for p > rate, never for p <= rate.
double chi2_tail(double statistic, double dof);

/// Probability that Student's t variable with `dof` > 0 degrees of freedom lies further from 0 than `t` (either side):
/// the p-value of a test of a mean whose variance is estimated from dof + 1 samples; NaN of NaN.
double student_tail(double t, double dof);

/// The t >= 0 with student_tail(t, dof) = p, for 0 < p <= 1.
double student_quantile(double p, double dof);

}  // namespace vpm
