// What goes with an eye ray: its random numbers, what it counts, and room to work in.
#pragma once

#include "vpm/base/rng.h"
#include "vpm/estimate/photon_map.h"
#include "vpm/estimate/statistics.h"
#include "vpm/estimate/volume/march.h"
#include "vpm/medium/density_integrals_along.h"

namespace vpm {

/// Buffers that outlive rays, so that these allocate nothing: one for each thread.
struct EyeScratch {
  DensityIntegralsAlong integrals;  // of the segment under way
  Marcher marcher;
  Neighbours neighbours;  // of the last gather by count
};

struct EyeWork {
  Rng& rng;
  EyeCounters& counters;
  EyeScratch& scratch;
  size_t pixel = 0;  // that the ray belongs to, numbered row by row

  /// What gathers on the ray's way count, and work in.
  GatherWork gather() { return {counters.gather, scratch.neighbours}; }
};

}  // namespace vpm
