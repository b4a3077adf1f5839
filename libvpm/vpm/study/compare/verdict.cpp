// Biases against what chance makes of many.
#include "vpm/study/compare/verdict.h"

#include <cmath>

#include "vpm/study/compare/resampling.h"

namespace vpm {
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
