// How photons are gathered: by radius or by count, with which kernel, and what becomes of it at borders.
#pragma once

#include <cstdint>

#include "vpm/base/counters.h"
#include "vpm/photon/kernel.h"
#include "vpm/photon/photon.h"

namespace vpm {

/// Around points by radius or by count; or, in media, beside whole stretches of rays (beam_estimate.h), by radius.
enum class GatherMode { radius, nearest, beam };

/// What is done where a disc or a ball reaches beyond the places that photons can come to: nothing, so that estimates
/// are too dark there and light leaks through walls; or the correction of BoundedMap.
enum class BoundaryRule { none, corrected };

struct GatherSettings {
  GatherMode mode = GatherMode::radius;
  float radius = 0.0f;  // m, > 0: of the first pass (radius, beam), or the largest allowed (nearest mode); 0: chosen by
                        // the scene's size
  uint32_t count = 50;  // nearest mode: k >= 2
  KernelKind kernel = KernelKind::epanechnikov;
  BoundaryRule boundary = BoundaryRule::none;
  uint32_t beam_count = 0;  // beam mode, > 0: each photon has a radius of its own, that of a ball of about so many
                            // photons, from a hundredth of `radius` to `radius`; 0: all have `radius`

  /// Is `radius` only the largest that a gather may take, so that what it takes is told by a count of photons?
  bool goes_by_count() const { return mode == GatherMode::nearest || (mode == GatherMode::beam && beam_count > 0); }
};

/// What gathering counts.
struct GatherCounters {
  uint64_t searches = 0;      // of maps: one for an estimate, as a rule; more at borders and where radii are asked for
  uint64_t visited = 0;       // by these: photons whose distance was computed
  uint64_t used = 0;          // photons that count in estimates, with whatever weight
  uint64_t corrected = 0;     // estimates at borders divided by a share of less than 1
  uint64_t least_shares = 0;  // of these, divided by kLeastShare in the place of less

  static constexpr auto counters() {
    using G = GatherCounters;
    return std::tuple{Counter{"map_searches", &G::searches}, Counter{"photons_visited", &G::visited},
                      Counter{"photons_used", &G::used}, Counter{"boundary_corrections", &G::corrected},
                      Counter{"boundary_least_shares", &G::least_shares}};
  }
  void merge(const GatherCounters& other) { merge_counters(*this, other); }
};
static_assert(lists_every_member<GatherCounters>());

}  // namespace vpm
