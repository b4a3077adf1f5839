// Which methods are biased, judged for all scenes of an experiment together.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace vpm {

/// The share of experiments without any bias in which one is called so.
inline constexpr double kFalseVerdicts = 0.01;

enum class BiasVerdict {
  none_seen,
  biased,
  undetermined,  // of weights without bound, from too few effective samples
  baseline       // what the others are compared with
};
std::string_view verdict_name(BiasVerdict verdict);

/// What is known of one method's bias on one scene.
struct BiasEvidence {
  BiasVerdict verdict = BiasVerdict::none_seen;  // or why it is not judged
  double p = 1.0;                                // of a bias so far from 0, were there none
  double p_holm = 1.0;                           // corrected for all that are judged
};

/// Judges those that are `none_seen` so far, by their p.
void judge(std::vector<BiasEvidence*> evidence);

}  // namespace vpm
