// Level: transport.
#include "study/validate/ladder.h"

namespace vpm {

std::vector<Experiment> transport_experiments() { return {}; }

}  // namespace vpm
