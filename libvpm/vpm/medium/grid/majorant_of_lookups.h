// The majorant of densities that are looked up at points of the world.
#pragma once

#include "vpm/medium/medium.h"

namespace vpm {

/// A bound that no look-up of a medium's density exceeds. Look-ups round: among voxels of the largest density their
/// result can exceed that density by some units in the last place.
inline double majorant_of_lookups(const Medium& medium) {
  constexpr double kRoom = 1.0 + 1e-6;
  return kRoom * static_cast<double>(medium.max_density());
}

}  // namespace vpm
