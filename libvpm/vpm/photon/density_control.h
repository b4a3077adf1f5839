// Removes photons where there are more than a map needs [Suykens2000]; the kept photons take over their power.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/photon/photon.h"

namespace vpm {

/// Keeps at most `most` >= 1 photons for each octant of directions of travel in each cube of the given edge (m, > 0):
/// the first ones. The power of the removed ones is divided equally among the kept ones, so that every cube keeps its
/// power. As photons are exchangeable, the mean at every place is also kept. Returns the number of removed photons. The
/// kept ones stay in their order.
uint64_t control_density(std::vector<Photon>& photons, float edge, uint32_t most);

}  // namespace vpm
