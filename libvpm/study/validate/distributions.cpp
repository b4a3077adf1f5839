// Level: distributions.
#include "study/validate/ladder.h"

namespace vpm {

std::vector<Experiment> distribution_experiments() { return {}; }

}  // namespace vpm
