// What repetitions of several methods on one scene say together.
#pragma once

#include <optional>
#include <vector>

#include "vpm/study/compare/errors.h"
#include "vpm/study/compare/plan.h"
#include "vpm/study/compare/resampling.h"

namespace vpm {

/// A method at one budget.
struct BudgetSummary {
  std::vector<RunCost> costs;         // by repetition
  std::vector<PictureErrors> each;    // by repetition
  RepeatedErrors errors;              // of all
  std::string why_bias_unknown = "";  // empty: it is known
};
/// `images` and `costs` are of the same repetitions, at least 3.
BudgetSummary summarise_budget(const std::vector<RunCost>& costs, const std::vector<Image>& images,
                               const Reference& reference);

/// Two methods at the last budget, by relative MSE: how many times as efficient the first one is.
struct PairSummary {
  size_t first, second;
  Comparison comparison;
};

struct MethodSummary {
  std::vector<Comparison> by_mse, by_relative_mse, by_variance;  // by budget: efficiency over that of the best method
  std::vector<std::optional<Tested>> own_bias;  // by budget: of the mean, against that of the baseline; of others only
  ConfidenceInterval slope;                     // of relative MSE over cost; NaN at a single budget
  std::vector<std::optional<double>> equal_error;  // by target: the cost at which it is reached
};

struct SceneSummary {
  std::vector<size_t> best_by_mse, best_by_relative_mse, best_by_variance;  // by budget: that of the largest efficiency
  std::vector<double> targets;  // relative MSEs that the best one had at the budgets
  std::vector<MethodSummary> methods;
  std::vector<PairSummary> pairs;  // of all methods, corrected for being so many
};
/// `budgets` by method, then budget. Efficiency is 1/(error cost), cost in that unit. `baseline`: the method whose bias
/// all have in common.
SceneSummary summarise_scene(const std::vector<std::vector<BudgetSummary>>& budgets, CostUnit unit,
                             std::optional<size_t> baseline);

}  // namespace vpm
