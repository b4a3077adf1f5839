// The jackknife, and the correction for many comparisons.
#include "vpm/study/compare/resampling.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "vpm/base/statistics/line_fit.h"
#include "vpm/base/statistics/moments.h"
#include "vpm/base/statistics/tails.h"

namespace vpm {
namespace {

constexpr double kRate = 0.05;  // of intervals that miss
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Estimate {
  double value, error;  // a standard error
};

/// The statistic of all repetitions, and its error from its values with one of them less.
Estimate jackknifed(size_t count, const Statistic& statistic) {
  std::vector<double> weights(count, 1.0);
  Moments with_one_less;
  for (double& weight : weights) {
    weight = 0.0;
    with_one_less.add(statistic(weights));
    weight = 1.0;
  }
  const auto n = static_cast<double>(count);
  return {statistic(weights), (n - 1.0) * std::sqrt(with_one_less.variance() / n)};
}

ConfidenceInterval with_interval(const Estimate& estimate, double dof) {
  const double reach = student_quantile(kRate, dof) * estimate.error;
  return {estimate.value, estimate.value - reach, estimate.value + reach};
}

Tested tested(const Estimate& estimate, double dof) {
  const auto& [value, error] = estimate;
  if (error == 0.0) return {{value, value, value}, value == 0.0 ? 1.0 : 0.0};
  return {with_interval(estimate, dof), student_tail(value / error, dof)};
}

double weighted_mean(const std::vector<double>& weights, const std::vector<double>& values) {
  Sum sum, all;
  for (size_t i = 0; i < values.size(); ++i) {
    sum.add(weights[i] * values[i]);
    all.add(weights[i]);
  }
  return sum.value() / all.value();
}

/// Whether the noise of the reference hides the error: the mean does not differ from 0 clearly, and may be below as
/// some are.
bool is_hidden(const Repetitions& of) {
  std::vector<double> weights(of.costs.size(), 0.0);
  bool any_below = false;
  for (double& weight : weights) {
    weight = 1.0;
    any_below |= of.error(weights) <= 0.0;
    weight = 0.0;
  }
  return any_below && !(jackknife(of.costs.size(), of.error).lo > 0.0);
}

}  // namespace

Tested mean_beside(const std::vector<double>& samples, double error) {
  Moments moments;
  for (const double sample : samples) moments.add(sample);
  const double own = moments.variance_of_mean(), all = own + error * error;
  // That of the expected value is known: it has infinitely many degrees of freedom.
  const double share = own > 0.0 ? own / all : 0.0, dof = static_cast<double>(samples.size() - 1) / (share * share);
  return tested({moments.mean(), std::sqrt(all)}, dof);
}

ConfidenceInterval mean_with_interval(const std::vector<double>& samples) { return mean_beside(samples, 0.0).value; }

Tested relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  assert(a.size() == b.size());
  const Statistic difference = [&](const std::vector<double>& weights) {
    return weighted_mean(weights, a) / weighted_mean(weights, b) - 1.0;
  };
  return tested(jackknifed(a.size(), difference), static_cast<double>(a.size() - 1));
}

ConfidenceInterval jackknife(size_t count, const Statistic& statistic) {
  assert(count >= 3);
  const Estimate estimate = jackknifed(count, statistic);
  if (std::isnan(estimate.value) || std::isnan(estimate.error)) return {estimate.value, kUnknown, kUnknown};
  return with_interval(estimate, static_cast<double>(count - 1));
}

Statistic mean_of(std::vector<double> samples) {
  return [samples = std::move(samples)](const std::vector<double>& weights) { return weighted_mean(weights, samples); };
}

Statistic variance_of(std::vector<std::vector<double>> distances) {
  return [distances = std::move(distances)](const std::vector<double>& weights) {
    Sum sum, all;
    for (size_t i = 0; i < distances.size(); ++i)
      for (size_t j = 0; j < i; ++j) {
        sum.add(weights[i] * weights[j] * distances[i][j]);
        all.add(weights[i] * weights[j]);
      }
    return 0.5 * sum.value() / all.value();
  };
}

double mean_error(const Repetitions& of) { return of.error(std::vector<double>(of.costs.size(), 1.0)); }

double mean_cost(const Repetitions& of) { return weighted_mean(std::vector<double>(of.costs.size(), 1.0), of.costs); }

Comparison compare_efficiency(const Repetitions& a, const Repetitions& b) {
  const size_t count = a.costs.size();
  assert(count >= 3 && b.costs.size() == count);
  const auto log_inefficiency = [](const Repetitions& of, const std::vector<double>& weights) {
    const double error = of.error(weights);
    return error > 0.0 ? std::log(error * weighted_mean(weights, of.costs)) : kUnknown;
  };
  const Estimate log_ratio = jackknifed(count, [&](const std::vector<double>& weights) {
    return log_inefficiency(b, weights) - log_inefficiency(a, weights);
  });
  Comparison result;
  result.ratio = {std::exp(log_ratio.value), kUnknown, kUnknown};
  if (is_hidden(a) || is_hidden(b) || std::isnan(log_ratio.value) || std::isnan(log_ratio.error)) return result;
  const Tested log = tested(log_ratio, static_cast<double>(count - 1));
  result.ratio.lo = std::exp(log.value.lo);
  result.ratio.hi = std::exp(log.value.hi);
  result.p = result.p_holm = log.p;
  result.known = true;
  return result;
}

std::vector<double> corrected_for_many(const std::vector<double>& p) {
  std::vector<size_t> order(p.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return p[a] < p[b]; });
  std::vector<double> corrected(p.size());
  double largest = 0.0;
  for (size_t i = 0; i < order.size(); ++i) {
    largest = std::max(largest, std::min(1.0, p[order[i]] * static_cast<double>(order.size() - i)));
    corrected[order[i]] = largest;
  }
  return corrected;
}

void correct_for_many(std::vector<Comparison>& comparisons) {
  std::vector<Comparison*> known;
  for (Comparison& comparison : comparisons)
    if (comparison.known) known.push_back(&comparison);
  std::vector<double> p;
  for (const Comparison* comparison : known) p.push_back(comparison->p);
  const std::vector<double> corrected = corrected_for_many(p);
  for (size_t i = 0; i < known.size(); ++i) known[i]->p_holm = corrected[i];
}

ConfidenceInterval convergence_slope(const std::vector<Repetitions>& budgets) {
  assert(budgets.size() >= 2);
  const Statistic slope = [&](const std::vector<double>& weights) {
    std::vector<double> x, y;
    for (const Repetitions& budget : budgets) {
      x.push_back(std::log(weighted_mean(weights, budget.costs)));
      const double error = budget.error(weights);
      y.push_back(error > 0.0 ? std::log(error) : kUnknown);
    }
    const bool one_cost = std::all_of(x.begin(), x.end(), [&](double cost) { return cost == x[0]; });
    return one_cost ? kUnknown : fit_line(x, y).slope;
  };
  return jackknife(budgets.front().costs.size(), slope);
}

}  // namespace vpm
