// Jackknife, bootstrap, and the correction for many comparisons.
#include "study/compare/resampling.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "base/line_fit.h"
#include "base/rng.h"
#include "base/statistics.h"

namespace vpm {
namespace {

constexpr double kRate = 0.05;  // of intervals that miss
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The t >= 0 beyond which Student's variable lies, either side, with probability p.
double student_quantile(double p, double dof) {
  double lo = 0.0, hi = 1.0;
  while (student_tail(hi, dof) > p) hi *= 2.0;
  for (double middle = 0.5 * hi; middle != lo && middle != hi; middle = 0.5 * (lo + hi))
    (student_tail(middle, dof) >= p ? lo : hi) = middle;
  return lo;
}

struct Estimate {
  double value, error;  // a standard error
};

/// Of repetitions that are taken as often as the weights tell: the statistic, and its error from its values with one
/// of them less.
Estimate jackknifed(std::vector<double> weights, const Statistic& statistic) {
  const double all = statistic(weights);
  double count = 0.0, sum = 0.0, squares = 0.0;
  for (double& weight : weights) {
    if (weight == 0.0) continue;
    const double times = weight;
    weight -= 1.0;
    const double change = statistic(weights) - all;
    weight = times;
    count += times;
    sum += times * change;
    squares += times * change * change;
  }
  return {all, std::sqrt(std::max(0.0, (count - 1.0) / count * (squares - sum * sum / count)))};
}

Bounded with_interval(const Estimate& estimate, double dof) {
  const double reach = student_quantile(kRate, dof) * estimate.error;
  return {estimate.value, estimate.value - reach, estimate.value + reach};
}

double weighted_sum(const std::vector<double>& weights, const std::vector<double>& values) {
  Sum sum;
  for (size_t i = 0; i < values.size(); ++i) sum.add(weights[i] * values[i]);
  return sum.value();
}

/// log(error cost), up to a constant; NaN where the mean error is not above 0.
double log_inefficiency(const std::vector<double>& weights, const Repetitions& of) {
  const double error = weighted_sum(weights, of.errors);
  return error > 0.0 ? std::log(error * weighted_sum(weights, of.costs)) : kUnknown;
}

/// As many draws of repetitions as there are, with replacement.
std::vector<double> resample(size_t count, Rng& rng) {
  std::vector<double> weights(count, 0.0);
  for (size_t i = 0; i < count; ++i)
    weights[static_cast<size_t>(rng.uniform_double() * static_cast<double>(count))] += 1.0;
  return weights;
}

/// How far resamples fall from the statistic, in their own standard errors, in rising order. Empty where the statistic
/// is unknown of one of them.
std::vector<double> studentised(size_t count, double value, const Statistic& statistic) {
  constexpr uint64_t kResamples = 2000, kSeed = 1;
  std::vector<double> deviations;
  for (uint64_t i = 0; i < kResamples; ++i) {
    Rng rng(kSeed, rng_stream(RngUse::probe, 0), i);
    const Estimate drawn = jackknifed(resample(count, rng), statistic);
    if (std::isnan(drawn.value) || std::isnan(drawn.error)) return {};
    if (drawn.error > 0.0) deviations.push_back((drawn.value - value) / drawn.error);  // else one is all that was drawn
  }
  std::sort(deviations.begin(), deviations.end());
  return deviations;
}

}  // namespace

Bounded mean_with_interval(const std::vector<double>& samples) {
  Moments moments;
  for (const double sample : samples) moments.add(sample);
  return with_interval({moments.mean(), std::sqrt(moments.variance_of_mean())},
                       static_cast<double>(samples.size() - 1));
}

Tested relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  Moments of_a, of_b;
  for (const double sample : a) of_a.add(sample);
  for (const double sample : b) of_b.add(sample);
  const double ratio = of_a.mean() / of_b.mean(), scale = of_b.mean() * of_b.mean();
  const double part_a = of_a.variance_of_mean() / scale, part_b = ratio * ratio * of_b.variance_of_mean() / scale;
  const double error = std::sqrt(part_a + part_b);
  if (error == 0.0) return {{ratio - 1.0, ratio - 1.0, ratio - 1.0}, ratio == 1.0 ? 1.0 : 0.0};
  const auto freedom = [](const std::vector<double>& samples) { return static_cast<double>(samples.size() - 1); };
  const double dof =
      (part_a + part_b) * (part_a + part_b) / (part_a * part_a / freedom(a) + part_b * part_b / freedom(b));
  return {with_interval({ratio - 1.0, error}, dof), student_tail((ratio - 1.0) / error, dof)};
}

Bounded jackknife(size_t count, const Statistic& statistic) {
  assert(count >= 3);
  return with_interval(jackknifed(std::vector<double>(count, 1.0), statistic), static_cast<double>(count - 1));
}

Comparison compare_efficiency(const Repetitions& a, const Repetitions& b) {
  const size_t count = a.errors.size();
  assert(count >= 3 && b.errors.size() == count && a.costs.size() == count && b.costs.size() == count);
  const Statistic log_ratio = [&](const std::vector<double>& weights) {
    return log_inefficiency(weights, b) - log_inefficiency(weights, a);
  };
  const Estimate estimate = jackknifed(std::vector<double>(count, 1.0), log_ratio);
  Comparison result;
  result.ratio = {std::exp(estimate.value), kUnknown, kUnknown};
  if (std::isnan(estimate.value) || std::isnan(estimate.error)) return result;
  if (estimate.error == 0.0) {
    result.ratio.lo = result.ratio.hi = result.ratio.value;
    result.p = result.p_holm = estimate.value == 0.0 ? 1.0 : 0.0;
    result.known = true;
    return result;
  }
  const std::vector<double> deviations = studentised(count, estimate.value, log_ratio);
  if (deviations.empty()) return result;
  const auto quantile = [&](double p) {
    return deviations[static_cast<size_t>(p * static_cast<double>(deviations.size()))];
  };
  result.ratio.lo = std::exp(estimate.value - quantile(1.0 - kRate / 2.0) * estimate.error);
  result.ratio.hi = std::exp(estimate.value - quantile(kRate / 2.0) * estimate.error);
  result.p = result.p_holm = student_tail(estimate.value / estimate.error, static_cast<double>(count - 1));
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

Bounded convergence_slope(const std::vector<Repetitions>& budgets) {
  assert(budgets.size() >= 2);
  const Statistic slope = [&](const std::vector<double>& weights) {
    std::vector<double> x, y;
    for (const Repetitions& budget : budgets) {
      x.push_back(std::log(weighted_sum(weights, budget.costs)));
      const double error = weighted_sum(weights, budget.errors);
      y.push_back(error > 0.0 ? std::log(error) : kUnknown);
    }
    const bool one_cost = std::all_of(x.begin(), x.end(), [&](double cost) { return cost == x[0]; });
    return one_cost ? kUnknown : fit_line(x, y).slope;
  };
  return jackknife(budgets.front().errors.size(), slope);
}

}  // namespace vpm
