// p-values and verdicts.
#include "vpm/study/check.h"

#include <fmt/format.h>
#include <algorithm>
#include <cassert>
#include <limits>

#include "vpm/base/statistics/tails.h"

namespace vpm {

namespace {

Check statistical(std::string name, double value, double exact, double error, double p) {
  return {CheckKind::statistical, std::move(name), value, exact, error, p, "", Verdict::undetermined};
}

/// The p-value of a t-test; without any error, equality decides.
double tail_of(double difference, double error, double dof) {
  if (error == 0.0) return difference == 0.0 ? 1.0 : 0.0;
  return student_tail(difference / error, dof);
}

Check chi_square(std::string name, double statistic, double dof) {
  Check check = statistical(std::move(name), statistic, dof, std::sqrt(2.0 * dof), chi2_tail(statistic, dof));
  check.note = "chi-square, its mean, its standard deviation";
  return check;
}

double mean_square(const Moments& samples) {
  const auto n = static_cast<double>(samples.count());
  return samples.variance() * (n - 1.0) / n + samples.mean() * samples.mean();
}

std::string few(double size) { return fmt::format("effective sample size {:.0f}", size); }

}  // namespace

Check check_mean(std::string name, const Moments& samples, double exact, double exact_error) {
  assert(samples.count() >= 2);
  const double error = std::sqrt(samples.variance_of_mean() + exact_error * exact_error);
  const double p = tail_of(samples.mean() - exact, error, static_cast<double>(samples.count() - 1));
  return statistical(std::move(name), samples.mean(), exact, error, p);
}

Check check_within(std::string name, const Moments& samples, double exact, double bound) {
  assert(samples.count() >= 2);
  const double error = std::sqrt(samples.variance_of_mean());
  const double beyond = std::max(0.0, std::abs(samples.mean() - exact) - bound);
  const double p = tail_of(beyond, error, static_cast<double>(samples.count() - 1));
  Check check = statistical(std::move(name), samples.mean(), exact, error, p);
  check.note = fmt::format("p is of what exceeds {:.2g}, to which the exact value is known", bound);
  return check;
}

Check check_probability(std::string name, const Moments& zeros_and_ones, double exact) {
  constexpr double kFew = 1000.0;
  assert(exact > -1e-9 && exact < 1.0 + 1e-9);
  const double probability = std::clamp(exact, 0.0, 1.0);  // rounding may have left the range
  const auto trials = static_cast<double>(zeros_and_ones.count());
  const double hits = std::round(zeros_and_ones.mean() * trials), share = hits / trials;
  const double error = std::sqrt(probability * (1.0 - probability) / trials);
  const bool rare = probability < 0.5;
  const double expected = trials * (rare ? probability : 1.0 - probability), count = rare ? hits : trials - hits;
  if (expected >= kFew)
    return statistical(std::move(name), share, probability, error, normal_tail((share - probability) / error));
  const double as_many = count > 0.0 ? 1.0 - chi2_tail(2.0 * expected, 2.0 * count) : 1.0;
  const double as_few = chi2_tail(2.0 * expected, 2.0 * count + 2.0);
  return statistical(std::move(name), share, probability, error, std::min(1.0, 2.0 * std::min(as_many, as_few)));
}

Check check_value(std::string name, double value, double standard_error, double exact) {
  const double p = tail_of(value - exact, standard_error, std::numeric_limits<double>::infinity());
  return statistical(std::move(name), value, exact, standard_error, p);
}

Check check_same(std::string name, const Moments& a, const Moments& b) {
  assert(a.count() >= 2 && b.count() >= 2);
  const double va = a.variance_of_mean(), vb = b.variance_of_mean();
  const double dof = (va + vb) * (va + vb) /
                     (va * va / static_cast<double>(a.count() - 1) + vb * vb / static_cast<double>(b.count() - 1));
  const double error = std::sqrt(va + vb);
  return statistical(std::move(name), a.mean(), b.mean(), error, tail_of(a.mean() - b.mean(), error, dof));
}

Check check_distribution(std::string name, const std::vector<double>& counts,
                         const std::vector<double>& probabilities) {
  assert(counts.size() == probabilities.size());
  constexpr double kFewest = 10.0;  // expected in a cell
  double draws = 0.0;
  for (const double c : counts) draws += c;
  double statistic = 0.0, pooled_count = 0.0, pooled_expected = 0.0;
  int cells = 0;
  const auto add_cell = [&](double count, double expected) {
    statistic += (count - expected) * (count - expected) / expected;
    ++cells;
  };
  bool impossible = false;
  for (size_t i = 0; i < counts.size(); ++i) {
    const double expected = draws * probabilities[i];
    impossible |= expected == 0.0 && counts[i] > 0.0;
    if (!(expected < kFewest)) {  // or NaN, which must show
      add_cell(counts[i], expected);
    } else {
      pooled_count += counts[i];
      pooled_expected += expected;
    }
  }
  if (pooled_expected > 0.0) add_cell(pooled_count, pooled_expected);
  assert(cells > 1);
  const double dof = cells - 1;
  Check check = chi_square(std::move(name), statistic, dof);
  if (impossible) {
    check.p = 0.0;
    check.note = "a cell of probability 0 was hit";
  }
  return check;
}

double effective_sample_size(const Moments& samples) {
  const auto count = static_cast<double>(samples.count());
  return effective_sample_size(count * samples.mean(), count * mean_square(samples));
}

Check check_weighted_mean(std::string name, const Moments& samples, double exact) {
  const double size = effective_sample_size(samples);  // NaN of NaN, which must fail
  if (size < kLeastSampleSize) return not_determined(std::move(name), samples.mean(), exact, few(size));
  return check_mean(std::move(name), samples, exact);
}

Check check_weights(std::string name, const std::vector<Moments>& cells, const std::vector<double>& means,
                    const std::vector<double>& errors) {
  assert(cells.size() == means.size() && !cells.empty());
  const auto draws = static_cast<double>(cells[0].count());
  constexpr double kLeastInCell = 50.0;
  // With m_b the mean and s_b the mean square in cell b, the covariance of one draw is diag(s) - m m^T: a draw is in
  // one cell only. Its inverse is that of a rank-one change [Sherman1950].
  double squares = 0.0, across = 0.0, hit = 0.0, weight = 0.0, all_squares = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t b = 0; b < cells.size(); ++b) {
    const double error = errors.empty() ? 0.0 : errors[b];
    const double m = cells[b].mean(), s = mean_square(cells[b]) + draws * error * error, off = m - means[b];
    if (off != 0.0) squares += off * off / s;  // infinite where a cell is never hit but should be
    if (s == 0.0) continue;
    across += off * m / s;
    hit += m * m / s;
    weight += m;
    all_squares += mean_square(cells[b]);
    least = std::min(least, effective_sample_size(cells[b]));
  }
  const double size = draws * weight * weight / all_squares, rest = 1.0 - hit;
  const bool equal_weights = rest < 1e-9;  // then the weight of all draws together is known exactly
  if (!equal_weights) squares += across * across / rest;
  const double statistic = draws * squares;
  const double dof = static_cast<double>(cells.size()) - (equal_weights ? 1.0 : 0.0);
  if (size < kLeastSampleSize || least < kLeastInCell)
    return not_determined(std::move(name), statistic, dof, few(size < kLeastSampleSize ? size : least));
  if (equal_weights && std::fabs(across) > 1e-6) {
    Check check = chi_square(std::move(name), statistic, dof);
    check.p = 0.0;
    check.note = "equal weights that are not 1";
    return check;
  }
  if (equal_weights && errors.empty()) {  // counts: no variance has to be estimated
    std::vector<double> counts;
    for (const Moments& cell : cells) counts.push_back(draws * cell.mean());
    return check_distribution(std::move(name), counts, means);
  }
  return chi_square(std::move(name), statistic, dof);
}

Check check_bound(std::string name, double value, double exact, double bound) {
  return {CheckKind::bounded, std::move(name), value, exact, bound, 1.0, "", Verdict::undetermined};
}

Check not_determined(std::string name, double value, double exact, std::string why) {
  return {CheckKind::undetermined, std::move(name), value, exact, 0.0, 1.0, std::move(why), Verdict::undetermined};
}

double judge(std::vector<Check>& checks, double rate) {
  assert(rate > 0.0 && rate < 1.0);
  size_t tests = 0;
  for (const Check& check : checks) tests += check.kind == CheckKind::statistical;
  const double threshold = tests > 0 ? -std::expm1(std::log1p(-rate) / static_cast<double>(tests)) : rate;
  for (Check& check : checks) {
    if (check.kind == CheckKind::undetermined) continue;
    const bool passes = check.kind == CheckKind::statistical ? check.p >= threshold
                                                             : std::fabs(check.value - check.exact) <= check.error;
    check.verdict = passes ? Verdict::pass : Verdict::fail;
  }
  return threshold;
}

}  // namespace vpm
