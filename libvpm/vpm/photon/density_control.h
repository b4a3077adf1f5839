// Fewer photons where there are more than a map needs [Suykens2000]: what rejected ones carried goes to those kept.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/photon/photon.h"

namespace vpm {

/// Leaves at most `most` >= 1 photons of each octant of directions of travel in each cube of the given edge (m, > 0):
/// the first ones. The power of the others there is shared out among these evenly, so that every cube keeps its power,
/// and, photons being exchangeable, every place its mean. Returns how many photons went. The order of the rest stays.
uint64_t control_density(std::vector<Photon>& photons, float edge, uint32_t most);

}  // namespace vpm
