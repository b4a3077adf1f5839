// The energy ledger of photon tracing: every flow summed where it happens, none by subtraction.
#pragma once

#include <cstdint>

#include "vpm/base/statistics.h"
#include "vpm/base/vec.h"
#include "vpm/path/walk.h"

namespace vpm {

/// Sums over emitted photons. Divided by `emitted_count` they are in W.
struct Ledger {
  uint64_t emitted_count = 0;
  Rgbd emitted{0.0};
  Rgbd absorbed_in_media{0.0};
  Rgbd absorbed_on_surfaces{0.0};  // less what shading normals add: Scatter::flux_scale may be above 1
  Rgbd escaped{0.0};
  Rgbd cut{0.0};  // carried by photons that reached the limit of events
  uint64_t cut_count = 0;
  Moments imbalance;      // of each photon: (absorbed + escaped + cut - emitted) over channels, W; its mean is zero
  WeightMoments weights;  // of photons: PathWeight, power over emitted power
  uint64_t collisions = 0;
  uint64_t surface_hits = 0;
  uint64_t floored = 0;     // stored photons whose density was below TraceSettings::density_floor
  uint64_t non_finite = 0;  // photons dropped because their power was not finite
  WalkCounters walk;

  void merge(const Ledger& other);
};

}  // namespace vpm
