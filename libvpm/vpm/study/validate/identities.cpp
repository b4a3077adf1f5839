// Level 1: identities that hold in whole scenes and need no reference.
#include "vpm/study/validate/groups.h"

namespace vpm {

std::vector<Experiment> identity_experiments() {
  std::vector<Experiment> all;
  for (const auto& group : {furnace_experiments(), slanted_slab_experiments(), convex_body_experiments(),
                            infinite_medium_experiments(), track_length_experiments(), balance_experiments(),
                            symmetry_experiments(), medium_experiments(), picture_experiments()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

}  // namespace vpm
