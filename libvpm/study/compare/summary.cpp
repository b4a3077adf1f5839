// Efficiencies against the best method and between all pairs; costs of equal errors.
#include "study/compare/summary.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vpm {
namespace {

using Metric = double PictureErrors::*;

Repetitions repetitions_of(const BudgetSummary& budget, Metric metric, CostUnit unit) {
  Repetitions all;
  for (const PictureErrors& errors : budget.each) all.errors.push_back(errors.*metric);
  for (const RunCost& cost : budget.costs) all.costs.push_back(cost_in(unit, cost));
  return all;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// The method with the least error times cost. Errors that the reference's noise hides count as none.
size_t best_of(const std::vector<Repetitions>& methods) {
  const auto inefficiency = [](const Repetitions& of) { return std::max(0.0, mean(of.errors)) * mean(of.costs); };
  const auto less = [&](const Repetitions& a, const Repetitions& b) { return inefficiency(a) < inefficiency(b); };
  return static_cast<size_t>(std::min_element(methods.begin(), methods.end(), less) - methods.begin());
}

/// The cost at which a method's error comes down to `target`, on lines between the logarithms at its budgets; nothing
/// where it does so before the first budget or not by the last.
std::optional<double> cost_of(double target, const std::vector<Repetitions>& budgets) {
  for (size_t i = 0; i + 1 < budgets.size(); ++i) {
    const double before = mean(budgets[i].errors), after = mean(budgets[i + 1].errors);
    if (!(after > 0.0) || !(before >= target && after <= target)) continue;
    const double share = before > after ? std::log(before / target) / std::log(before / after) : 0.0;
    return std::exp((1.0 - share) * std::log(mean(budgets[i].costs)) + share * std::log(mean(budgets[i + 1].costs)));
  }
  return std::nullopt;
}

}  // namespace

BudgetSummary summarise_budget(const std::vector<RunCost>& costs, const std::vector<Image>& images,
                               const Reference& reference) {
  assert(images.size() >= 3 && costs.size() == images.size());
  BudgetSummary summary{costs, {}, repeated_errors(images, reference)};
  for (const Image& image : images) summary.each.push_back(picture_errors(image, reference));
  return summary;
}

SceneSummary summarise_scene(const std::vector<std::vector<BudgetSummary>>& budgets, CostUnit unit) {
  SceneSummary summary;
  summary.methods.resize(budgets.size());
  const size_t budget_count = budgets.front().size();
  std::vector<std::vector<Repetitions>> curves(budgets.size());  // of relative MSE, by method, then budget
  for (size_t b = 0; b < budget_count; ++b) {
    std::vector<Repetitions> absolute, relative;
    for (const std::vector<BudgetSummary>& method : budgets) {
      absolute.push_back(repetitions_of(method[b], &PictureErrors::mse, unit));
      relative.push_back(repetitions_of(method[b], &PictureErrors::relative_mse, unit));
    }
    summary.best_by_mse.push_back(best_of(absolute));
    summary.best_by_relative_mse.push_back(best_of(relative));
    const Repetitions& best = relative[summary.best_by_relative_mse.back()];
    summary.targets.push_back(mean(best.errors));
    for (size_t m = 0; m < budgets.size(); ++m) {
      summary.methods[m].by_mse.push_back(compare_efficiency(absolute[m], absolute[summary.best_by_mse.back()]));
      summary.methods[m].by_relative_mse.push_back(compare_efficiency(relative[m], best));
      curves[m].push_back(relative[m]);
    }
  }
  for (size_t m = 0; m < budgets.size(); ++m) {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    summary.methods[m].slope = budget_count > 1 ? convergence_slope(curves[m]) : Bounded{kUnknown, kUnknown, kUnknown};
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

}  // namespace vpm
