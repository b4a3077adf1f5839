// Which methods are biased, judged for all scenes of an experiment together.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vpm/study/compare/summary.h"

namespace vpm {

/// The most that the share of experiments without any bias can be in which one is called so.
inline constexpr double kFalseVerdicts = 0.01;

enum class BiasVerdict {
  none_seen,
  biased,
  undetermined,  // nothing is known, and why is told
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
