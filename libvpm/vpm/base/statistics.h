// Sums that keep their digits, running moments, and the tails of the distributions that tests need.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

namespace vpm {

/// A sum of doubles with a second double for the digits that rounding would lose [Neumaier1974]. An infinity
/// or a NaN among the terms shows in value().
class Sum {
 public:
  void add(double x) {
    const double t = sum_ + x;
    rest_ += std::fabs(sum_) >= std::fabs(x) ? (sum_ - t) + x : (x - t) + sum_;
    sum_ = t;
  }
  void merge(const Sum& other) {
    add(other.sum_);
    rest_ += other.rest_;
  }
  double value() const { return std::isfinite(sum_) ? sum_ + rest_ : sum_; }

 private:
  double sum_ = 0.0, rest_ = 0.0;
};

/// Count, mean and variance of samples seen one by one [Welford1962] or in groups [Chan1983].
class Moments {
 public:
  void add(double x) {
    ++count_;
    const double step = x - mean_;
    mean_ += step / static_cast<double>(count_);
    m2_ += step * (x - mean_);
  }
  void merge(const Moments& other) {
    if (other.count_ == 0) return;
    const auto n = static_cast<double>(count_), m = static_cast<double>(other.count_);
    const double step = other.mean_ - mean_;
    mean_ += step * (m / (n + m));
    m2_ += other.m2_ + step * step * (n * m / (n + m));
    count_ += other.count_;
  }

  uint64_t count() const { return count_; }
  /// 0 of no samples.
  double mean() const { return mean_; }
  /// Unbiased variance of one sample; NaN below two samples, where it is unknown.
  double variance() const {
    if (count_ < 2) return std::numeric_limits<double>::quiet_NaN();
    return m2_ / static_cast<double>(count_ - 1);
  }
  /// Variance of mean() over independent samples: the square of its standard error.
  double variance_of_mean() const { return variance() / static_cast<double>(count_); }

 private:
  uint64_t count_ = 0;
  double mean_ = 0.0;
  double m2_ = 0.0;  // sum of squared deviations from the mean
};

/// (sum w)^2 / sum w^2 of weights w: how many samples of equal weights would tell as much. Weights of either sign,
/// which partly cancel, count for less.
inline double effective_sample_size(double sum, double squares) { return squares == 0.0 ? 0.0 : sum * sum / squares; }

/// Weights of samples that stand for unequal shares of a mean.
struct WeightMoments {
  double sum = 0.0, squares = 0.0, largest = 0.0;  // the largest magnitude

  void add(double weight) {
    sum += weight;
    squares += weight * weight;
    at_least(weight);
  }
  /// Looks at a weight for the largest one only.
  void at_least(double weight) { largest = std::max(largest, std::fabs(weight)); }
  void merge(const WeightMoments& other) {
    sum += other.sum;
    squares += other.squares;
    largest = std::max(largest, other.largest);
  }
  double effective_sample_size() const { return vpm::effective_sample_size(sum, squares); }
};

/// Probability that a standard normal variable lies further from 0 than `z` (either side): the p-value of a z-test.
inline double normal_tail(double z) { return std::erfc(std::fabs(z) * 0.70710678118654752440); }

/// The z >= 0 with normal_tail(z) = p, for 0 < p <= 1: the threshold of a z-test with false-alarm rate p.
inline double normal_quantile(double p) {
  assert(p > 0.0 && p <= 1.0);
  double lo = 0.0, hi = 39.0;  // normal_tail(39) underflows to 0
  while (true) {
    const double middle = 0.5 * (lo + hi);
    if (middle == lo || middle == hi) return middle;
    (normal_tail(middle) >= p ? lo : hi) = middle;
  }
}

/// Gamma(a, x) / Gamma(a), a > 0, x >= 0: below a + 1 by the power series of its complement [Olver2010, eq. 8.7.1],
/// else by the even part of its continued fraction [Olver2010, eq. 8.9.2], evaluated forwards by Lentz's method.
inline double upper_gamma_fraction(double a, double x) {
  if (x == 0.0) return 1.0;
  if (std::isinf(x)) return 0.0;
  const double factor = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (double n = a + 1.0; term > 1e-17 * sum; n += 1.0) sum += term *= x / n;
    return 1.0 - factor * sum;
  }
  double b = x + 1.0 - a, c = std::numeric_limits<double>::infinity(), d = 1.0 / b, value = d, change = 0.0;
  for (double n = 1.0; std::fabs(change - 1.0) > 1e-15; n += 1.0) {
    const double an = n * (a - n);
    b += 2.0;
    c = b + an / c;
    d = 1.0 / (b + an * d);
    value *= change = c * d;
  }
  return factor * value;
}

/// Probability that a chi-square variable with `dof` > 0 degrees of freedom exceeds `statistic` >= 0: the p-value of a
/// chi-square test. NaN of NaN, so test for p > rate, never for p <= rate.
inline double chi2_tail(double statistic, double dof) {
  assert(dof > 0.0 && !(statistic < 0.0));
  return std::isnan(statistic) ? statistic : upper_gamma_fraction(0.5 * dof, 0.5 * statistic);
}

/// Probability that Student's t variable with `dof` > 0 degrees of freedom lies further from 0 than `t` (either side):
/// the p-value of a test of a mean whose variance is estimated from dof + 1 samples; NaN of NaN. It is the regularised
/// incomplete beta function I_x(dof / 2, 1 / 2) at x = dof / (dof + t^2) [Olver2010, eq. 8.17.2], by its continued
/// fraction [Olver2010, eq. 8.17.22] on the side of its symmetry where that converges fast.
inline double student_tail(double t, double dof) {
  assert(!(dof <= 0.0));
  if (std::isnan(t) || std::isnan(dof)) return std::numeric_limits<double>::quiet_NaN();
  if (dof > 1e7) return normal_tail(t);
  const double square = t * t, x = dof / (dof + square), rest = square / (dof + square);
  const auto fraction = [](double a, double b, double y) {
    double c = 1.0, d = 1.0 - (a + b) * y / (a + 1.0);
    d = 1.0 / d;
    double value = d, change = 0.0;
    for (double m = 1.0; std::fabs(change - 1.0) > 1e-15 && m < 1e4; m += 1.0) {
      const double even = m * (b - m) * y / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
      d = 1.0 / (1.0 + even * d);
      c = 1.0 + even / c;
      value *= d * c;
      const double odd = -(a + m) * (a + b + m) * y / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
      d = 1.0 / (1.0 + odd * d);
      c = 1.0 + odd / c;
      value *= change = d * c;
    }
    return value;
  };
  const double a = 0.5 * dof, b = 0.5;
  const double factor =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log(rest));
  if (square == 0.0) return 1.0;
  return x < (a + 1.0) / (a + b + 2.0) ? factor * fraction(a, b, x) / a : 1.0 - factor * fraction(b, a, rest) / b;
}

}  // namespace vpm
