// How photons are gathered: by radius or by count, with which kernel, and what becomes of it at borders.
#pragma once

#include <cstdint>

#include "photon/kernel.h"
#include "photon/photon.h"

namespace vpm {

enum class GatherMode { radius, nearest };

/// What is done where a disc or a ball reaches beyond the places that photons can come to: nothing, so that estimates
/// are too dark there and light leaks through walls; or the correction of BoundedMap.
enum class BoundaryRule { none, corrected };

struct GatherSettings {
  GatherMode mode = GatherMode::radius;
  float radius = 0.0f;  // m, > 0: of the first pass (radius mode), or the largest allowed (nearest mode); 0: chosen by
                        // the scene's size
  uint32_t count = 50;  // nearest mode: k >= 2
  KernelKind kernel = KernelKind::epanechnikov;
  BoundaryRule boundary = BoundaryRule::none;
};

/// A gather in radius mode of a radius of its own, from a map that was made for about that.
struct CountedGather {
  GatherSettings settings;
  uint64_t* found;  // grows by the photons that count, with whatever weight
};

}  // namespace vpm
