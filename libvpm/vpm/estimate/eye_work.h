// What an eye ray takes along: its random numbers, its counters, and memory to work in.
#pragma once

#include <vector>

#include "vpm/base/rng.h"
#include "vpm/estimate/photon_map.h"
#include "vpm/estimate/statistics.h"
#include "vpm/estimate/volume/march.h"
#include "vpm/medium/density_integrals_along.h"
#include "vpm/path/walk.h"

namespace vpm {

/// Buffers, one set for each thread. They outlive rays, so that rays allocate nothing.
struct EyeScratch {
  DensityIntegralsAlong integrals;  // of the current segment
  Marcher marcher;
  Neighbours neighbours;      // of the last gather by count
  std::vector<Track> tracks;  // of the last flight
};

struct EyeWork {
  Rng& rng;
  EyeCounters& counters;
  EyeScratch& scratch;
  size_t pixel = 0;  // the pixel that the ray belongs to, numbered row by row

  /// The counters and the memory for gathers along the ray.
  GatherWork gather() { return {counters.gather, scratch.neighbours}; }
};

}  // namespace vpm
