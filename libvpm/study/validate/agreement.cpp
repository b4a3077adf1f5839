// Level: agreement.
#include "study/validate/ladder.h"

namespace vpm {

std::vector<Experiment> agreement_experiments() { return {}; }

}  // namespace vpm
