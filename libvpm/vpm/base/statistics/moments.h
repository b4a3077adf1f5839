// Sums with little rounding error, and running moments.
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
  /// The mean; 0 if there are no samples.
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

/// (sum w)^2 / sum w^2 of weights w: the number of samples of equal weights that would be as informative. Weights of
/// both signs partly cancel, and so count for less.
inline double effective_sample_size(double sum, double squares) { return squares == 0.0 ? 0.0 : sum * sum / squares; }

/// Moments of the weights of samples that contribute unequal fractions to a mean.
struct WeightMoments {
  double sum = 0.0, squares = 0.0, largest = 0.0;  // the largest magnitude

  void add(double weight) {
    sum += weight;
    squares += weight * weight;
    at_least(weight);
  }
  /// Uses a weight for `largest` only.
  void at_least(double weight) { largest = std::max(largest, std::fabs(weight)); }
  void merge(const WeightMoments& other) {
    sum += other.sum;
    squares += other.squares;
    largest = std::max(largest, other.largest);
  }
  double effective_sample_size() const { return vpm::effective_sample_size(sum, squares); }
};

}  // namespace vpm
