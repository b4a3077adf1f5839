// Level 0: single draws follow their laws.
#include "vpm/study/validate/groups.h"

namespace vpm {

std::vector<Experiment> distribution_experiments() {
  std::vector<Experiment> all;
  for (const auto& group : {flight_experiments(), transmittance_experiments(), phase_experiments(),
                            outcome_experiments(), material_experiments(), filter_experiments(), emission_experiments(),
                            irradiance_experiments(), photon_map_experiments(), border_experiments(),
                            guide_experiments(), pane_experiments(), technique_experiments()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

}  // namespace vpm
