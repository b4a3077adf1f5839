// What repetitions of several methods say together: on one scene, and of all scenes of an experiment which methods are
// biased.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vpm/study/compare/errors.h"
#include "vpm/study/compare/experiment.h"
#include "vpm/study/compare/resampling.h"

namespace vpm {

/// What a method costs at one budget, and how large its errors are.
struct BudgetSummary {
  std::vector<RunCost> costs;         // by repetition
  std::vector<PictureErrors> each;    // by repetition
  RepeatedErrors errors;              // of all repetitions, which are taken for independent ones
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

/// The most that the share of experiments without any bias can be in which one is called so.
inline constexpr double kFalseVerdicts = 0.01;

enum class BiasVerdict {
  none_seen,
  biased,
  undetermined,  // nothing is known, for a reason that is given
  baseline       // what the others are compared with
};
std::string_view verdict_name(BiasVerdict verdict);

/// What is known of one method's bias on one scene.
struct BiasEvidence {
  BiasVerdict verdict = BiasVerdict::none_seen;
  double p = 1.0;        // of a bias so far from 0, were there none
  double p_holm = 1.0;   // corrected for all that are judged [Holm1979]
  std::string why = "";  // it is undetermined
};
inline bool is_judged(const BiasEvidence& evidence) {
  return evidence.verdict == BiasVerdict::none_seen || evidence.verdict == BiasVerdict::biased;
}

/// Of each method of a scene at the last budget, none judged yet: of the bias against the baseline, where there is one,
/// else against the reference. Nothing can be judged against what is in doubt itself. `budgets` by method, then budget.
std::vector<BiasEvidence> bias_evidence(const std::vector<std::vector<BudgetSummary>>& budgets,
                                        const SceneSummary& summary, std::optional<size_t> baseline,
                                        const Reference& reference);

/// Judges all that are not undetermined, nor the baseline, by their p.
void judge(std::vector<BiasEvidence*> evidence);

}  // namespace vpm
