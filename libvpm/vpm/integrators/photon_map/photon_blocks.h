// A pass of more photons than memory holds: blocks of them are traced, gathered and dropped, one after the other.
//
// What is gathered from maps is a sum over photons, each of its power over the photons emitted; all other light is the
// same whichever photons there are. So a block makes a whole picture, as if its photons were all of the pass, along the
// eye paths that the pass has. The picture of the pass is the mean of these, each weighted by its photons. It is that
// of all photons at once, up to rounding (PackedPower), as eye paths draw the same random numbers in every block: what
// they draw must not depend on photons.
#pragma once

#include <cstdint>
#include <functional>

#include "vpm/film/pass.h"
#include "vpm/integrators/settings.h"

namespace vpm {

/// Some photons of a pass: `count` of them, from number `first` on.
struct PhotonBlock {
  uint64_t first = 0, count = 0;
};

/// How many blocks a pass has: as few as have no more than `photons.block` photons; 1 where that is 0, and where a pass
/// is none of photon maps.
uint64_t block_count(const RenderSettings& settings);
/// One of these, from 0. They have the same number of photons, or one more.
PhotonBlock photon_block(const RenderSettings& settings, uint64_t number);

/// The mean of what `render` makes of each block; of a single one just that. What is counted is the sum over blocks: so
/// many rays are followed, so many photons found. Layers of what the camera sees are those of any block.
Pass mean_of_blocks(const RenderSettings& settings, const std::function<Pass(const PhotonBlock&)>& render);

}  // namespace vpm
