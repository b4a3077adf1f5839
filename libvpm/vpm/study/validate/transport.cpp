// Level 2: reflection, transmission, absorption, radiance and fluence against exact solutions of transport theory.
#include "vpm/study/validate/groups.h"

namespace vpm {

std::vector<Experiment> transport_experiments() {
  std::vector<Experiment> all;
  for (const auto& group : {slab_experiments(), slab_radiance_experiments(), source_experiments()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

}  // namespace vpm
