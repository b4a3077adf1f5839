// Efficiencies against the best method and between all pairs; costs of equal errors; biases against what chance makes
// of many.
#include "vpm/study/compare/summary.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "vpm/study/compare/resampling.h"

namespace vpm {
namespace {

std::vector<double> values_of(const BudgetSummary& budget, double PictureErrors::*metric) {
  std::vector<double> values;
  for (const PictureErrors& errors : budget.each) values.push_back(errors.*metric);
  return values;
}

/// An error, with what the repetitions cost.
Repetitions with_costs(Statistic error, const BudgetSummary& budget, CostUnit unit) {
  Repetitions all{std::move(error), {}};
  for (const RunCost& cost : budget.costs) all.costs.push_back(cost_in(unit, cost));
  return all;
}

/// The method with the least error times cost. Errors that the reference's noise hides count as none.
size_t best_of(const std::vector<Repetitions>& methods) {
  const auto inefficiency = [](const Repetitions& of) { return std::max(0.0, mean_error(of)) * mean_cost(of); };
  const auto less = [&](const Repetitions& a, const Repetitions& b) { return inefficiency(a) < inefficiency(b); };
  return static_cast<size_t>(std::min_element(methods.begin(), methods.end(), less) - methods.begin());
}

/// The cost at which a method's error comes down to `target`, on lines between the logarithms at its budgets; nothing
/// where it does so before the first budget or not by the last.
std::optional<double> cost_of(double target, const std::vector<Repetitions>& budgets) {
  for (size_t i = 0; i + 1 < budgets.size(); ++i) {
    const double before = mean_error(budgets[i]), after = mean_error(budgets[i + 1]);
    if (!(after > 0.0) || !(before >= target && after <= target)) continue;
    const double share = before > after ? std::log(before / target) / std::log(before / after) : 0.0;
    return std::exp((1.0 - share) * std::log(mean_cost(budgets[i])) + share * std::log(mean_cost(budgets[i + 1])));
  }
  return std::nullopt;
}

/// MethodSummary::own_bias of method `m` at budget `b`.
std::optional<Tested> bias_against(std::optional<size_t> baseline, size_t m, size_t b,
                                   const std::vector<std::vector<BudgetSummary>>& budgets) {
  if (!baseline || *baseline == m) return std::nullopt;
  return relative_difference(values_of(budgets[m][b], &PictureErrors::mean_ratio),
                             values_of(budgets[*baseline][b], &PictureErrors::mean_ratio));
}

}  // namespace

BudgetSummary summarise_budget(const std::vector<RunCost>& costs, const std::vector<Image>& images,
                               const Reference& reference) {
  assert(images.size() >= 3 && costs.size() == images.size());
  BudgetSummary summary{costs, {}, repeated_errors(images, reference)};
  for (const Image& image : images) summary.each.push_back(picture_errors(image, reference));
  return summary;
}

SceneSummary summarise_scene(const std::vector<std::vector<BudgetSummary>>& budgets, CostUnit unit,
                             std::optional<size_t> baseline) {
  SceneSummary summary;
  summary.methods.resize(budgets.size());
  const size_t budget_count = budgets.front().size();
  std::vector<std::vector<Repetitions>> curves(budgets.size());  // of relative MSE, by method, then budget
  for (size_t b = 0; b < budget_count; ++b) {
    std::vector<Repetitions> absolute, relative, variance;
    for (const std::vector<BudgetSummary>& method : budgets) {
      absolute.push_back(with_costs(mean_of(values_of(method[b], &PictureErrors::mse)), method[b], unit));
      relative.push_back(with_costs(mean_of(values_of(method[b], &PictureErrors::relative_mse)), method[b], unit));
      variance.push_back(with_costs(variance_of(method[b].errors.distances), method[b], unit));
    }
    summary.best_by_mse.push_back(best_of(absolute));
    summary.best_by_relative_mse.push_back(best_of(relative));
    summary.best_by_variance.push_back(best_of(variance));
    const Repetitions& best = relative[summary.best_by_relative_mse.back()];
    summary.targets.push_back(mean_error(best));
    for (size_t m = 0; m < budgets.size(); ++m) {
      MethodSummary& method = summary.methods[m];
      method.by_mse.push_back(compare_efficiency(absolute[m], absolute[summary.best_by_mse.back()]));
      method.by_relative_mse.push_back(compare_efficiency(relative[m], best));
      method.by_variance.push_back(compare_efficiency(variance[m], variance[summary.best_by_variance.back()]));
      method.own_bias.push_back(bias_against(baseline, m, b, budgets));
      curves[m].push_back(relative[m]);
    }
  }
  for (size_t m = 0; m < budgets.size(); ++m) {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    summary.methods[m].slope =
        budget_count > 1 ? convergence_slope(curves[m]) : ConfidenceInterval{kUnknown, kUnknown, kUnknown};
    for (const double target : summary.targets) summary.methods[m].equal_error.push_back(cost_of(target, curves[m]));
  }
  std::vector<Comparison> comparisons;
  for (size_t a = 0; a < budgets.size(); ++a)
    for (size_t b = a + 1; b < budgets.size(); ++b) {
      comparisons.push_back(compare_efficiency(curves[a].back(), curves[b].back()));
      summary.pairs.push_back({a, b, {}});
    }
  correct_for_many(comparisons);
  for (size_t i = 0; i < comparisons.size(); ++i) summary.pairs[i].comparison = comparisons[i];
  return summary;
}

namespace {

BiasEvidence undetermined(std::string why) { return {BiasVerdict::undetermined, 1.0, 1.0, std::move(why)}; }

/// Why biases cannot be judged against the baseline, or against the reference where there is no baseline; empty where
/// they can.
std::string doubt_of_truth(const std::vector<std::vector<BudgetSummary>>& budgets, std::optional<size_t> baseline,
                           const Reference& reference) {
  if (!baseline) return reference.doubt;
  const std::string& why = budgets[*baseline].back().why_bias_unknown;
  return why.empty() ? "" : "the baseline's " + why;
}

}  // namespace

std::string_view verdict_name(BiasVerdict verdict) {
  switch (verdict) {
    case BiasVerdict::none_seen:
      return "none seen";
    case BiasVerdict::biased:
      return "biased";
    case BiasVerdict::undetermined:
      return "not determined";
    case BiasVerdict::baseline:
      break;
  }
  return "baseline";
}

std::vector<BiasEvidence> bias_evidence(const std::vector<std::vector<BudgetSummary>>& budgets,
                                        const SceneSummary& summary, std::optional<size_t> baseline,
                                        const Reference& reference) {
  const std::string doubt = doubt_of_truth(budgets, baseline, reference);
  std::vector<BiasEvidence> evidence;
  for (size_t m = 0; m < budgets.size(); ++m) {
    const BudgetSummary& last = budgets[m].back();
    const std::optional<Tested>& own = summary.methods[m].own_bias.back();
    const double p = own ? own->p : last.errors.bias_p;
    if (baseline == m)
      evidence.push_back({BiasVerdict::baseline});
    else if (!last.why_bias_unknown.empty())
      evidence.push_back(undetermined(last.why_bias_unknown));
    else if (!doubt.empty())
      evidence.push_back(undetermined(doubt));
    else if (std::isnan(p))
      evidence.push_back(undetermined("its pictures or the truth have no finite mean above 0"));
    else
      evidence.push_back({BiasVerdict::none_seen, p});
  }
  return evidence;
}

void judge(std::vector<BiasEvidence*> evidence) {
  std::erase_if(evidence, [](const BiasEvidence* one) { return !is_judged(*one); });
  std::vector<double> p;
  for (const BiasEvidence* one : evidence) p.push_back(one->p);
  const std::vector<double> corrected = corrected_for_many(p);
  for (size_t i = 0; i < evidence.size(); ++i) {
    evidence[i]->p_holm = corrected[i];
    if (corrected[i] < kFalseVerdicts) evidence[i]->verdict = BiasVerdict::biased;
  }
}

}  // namespace vpm
