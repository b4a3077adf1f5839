// Level: convergence.
#include "study/validate/ladder.h"

namespace vpm {

std::vector<Experiment> convergence_experiments() { return {}; }

}  // namespace vpm
