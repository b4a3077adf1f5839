// Level: identities.
#include "study/validate/ladder.h"

namespace vpm {

std::vector<Experiment> identity_experiments() { return {}; }

}  // namespace vpm
