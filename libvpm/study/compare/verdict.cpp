// Biases against what chance makes of many.
#include "study/compare/verdict.h"

#include "study/compare/resampling.h"

namespace vpm {

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

void judge(std::vector<BiasEvidence*> evidence) {
  std::erase_if(evidence, [](const BiasEvidence* one) { return one->verdict != BiasVerdict::none_seen; });
  std::vector<double> p;
  for (const BiasEvidence* one : evidence) p.push_back(one->p);
  const std::vector<double> corrected = corrected_for_many(p);
  for (size_t i = 0; i < evidence.size(); ++i) {
    evidence[i]->p_holm = corrected[i];
    if (corrected[i] < kFalseVerdicts) evidence[i]->verdict = BiasVerdict::biased;
  }
}

}  // namespace vpm
