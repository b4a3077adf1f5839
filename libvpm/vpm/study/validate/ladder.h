// The ladder of validation: experiments on five levels, from the distribution of one draw to how fast whole images
// converge. Each level trusts those below it.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "vpm/study/check.h"

namespace vpm {

/// How much work an experiment does, and with which random numbers.
struct Effort {
  uint64_t seed = 1;
  bool full = false;  // tight errors, some fifteen times the work

  /// A number of samples.
  uint64_t count(uint64_t quick, uint64_t tight) const { return full ? tight : quick; }
  /// The seed of one part of an experiment: independent between names, so that no two checks share their random
  /// numbers.
  uint64_t seed_of(std::string_view name) const;
};

struct Experiment {
  int level = 0;
  std::string name;  // of the group of checks, e.g. "slabs: reflected and transmitted flux"
  std::function<std::vector<Check>(const Effort&)> run;
};

/// The experiments of each level.
std::vector<Experiment> distribution_experiments();  // 0: single draws
std::vector<Experiment> identity_experiments();      // 1: identities that need no reference
std::vector<Experiment> transport_experiments();     // 2: exact solutions of transport
std::vector<Experiment> agreement_experiments();     // 3: every way to the same picture
std::vector<Experiment> convergence_experiments();   // 4: how errors fall

inline constexpr int kLevels = 5;
std::string_view level_title(int level);

/// The experiments of one level, or of all (level < 0), in order.
std::vector<Experiment> experiments(int level);

}  // namespace vpm
