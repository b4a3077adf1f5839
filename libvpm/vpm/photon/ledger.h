// The energy ledger of photon tracing. Every flow is summed where it happens; none is found by subtraction.
#pragma once

#include <cstdint>

#include "vpm/base/statistics/channel_moments.h"
#include "vpm/base/vec.h"
#include "vpm/path/walk.h"

namespace vpm {

/// Sums over emitted photons. Divided by `emitted_count` they are in W.
struct Ledger {
  uint64_t emitted_count = 0;
  Rgbd emitted{0.0};
  Rgbd absorbed_in_media{0.0};
  Rgbd absorbed_on_surfaces{0.0};  // minus what shading normals add: Scatter::flux_scale may be above 1
  Rgbd escaped{0.0};
  Rgbd cut{0.0};  // carried by photons that reached the limit of events
  uint64_t cut_count = 0;
  ChannelMoments imbalance;  // of each photon: absorbed + escaped + cut - emitted, W; its mean is zero; its standard
                             // error is as if photons were independent of each other
  WeightMoments weights;     // of photons: PathWeight of power over emitted power
  uint64_t collisions = 0;
  uint64_t surface_hits = 0;
  uint64_t floored = 0;     // stored photons where the density is below the floor of stored_power()
  uint64_t non_finite = 0;  // photons dropped because their power was not finite
  WalkCounters walk;

  static constexpr auto counters() {
    using L = Ledger;
    return std::tuple{Counter{"photons.emitted", &L::emitted_count},
                      Counter{"energy.emitted", &L::emitted},
                      Counter{"energy.absorbed_in_media", &L::absorbed_in_media},
                      Counter{"energy.absorbed_on_surfaces", &L::absorbed_on_surfaces},
                      Counter{"energy.escaped", &L::escaped},
                      Counter{"energy.cut_at_max_events", &L::cut},
                      Counter{"photons.paths_cut_at_max_events", &L::cut_count},
                      Counter{"energy.imbalance", &L::imbalance},
                      Counter{"photons.weights", &L::weights},
                      Counter{"photons.collisions", &L::collisions},
                      Counter{"photons.surface_hits", &L::surface_hits},
                      Counter{"photons.below_density_floor", &L::floored},
                      Counter{"photons.dropped_non_finite", &L::non_finite},
                      Counter{"photons", &L::walk}};
  }
  void merge(const Ledger& other);
};
static_assert(lists_every_member<Ledger>());

}  // namespace vpm
