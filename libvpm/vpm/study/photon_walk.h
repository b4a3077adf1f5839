// The walk of one photon, for studies that keep tallies of their own.
#pragma once

#include <limits>

#include "vpm/path/walk.h"

namespace vpm {

/// Of events, for photons that come to an end by themselves.
inline constexpr int kNoLimit = std::numeric_limits<int>::max();

/// Follows a photon until it is absorbed, escapes, has lost all power or met `max_events` events. Calls see(const
/// Event&, const PathState&) at every event, the last one included, before its outcome is drawn: the state stands at
/// the event and has the direction and power with which it arrived. Collisions scatter by scatter_in_medium(), surfaces
/// by scatter_at_surface().
template <class See>
void follow_photon(const Scene& scene, const DistanceStrategy& strategy, PathState state, int max_events, Rng& rng,
                   WalkCounters& counters, See&& see) {
  bool alive = true;
  for (int events = 0; alive && events < max_events; ++events) {
    const Event event = next_event(scene, strategy, state, rng, counters);
    see(event, static_cast<const PathState&>(state));
    if (event.kind == EventKind::escape || is_black(state.power)) return;
    Scatter scatter;
    alive = event.kind == EventKind::collision ? scatter_in_medium(scene.media[state.medium], state, rng)
                                               : scatter_at_surface(scene, event.hit, state, rng, scatter);
  }
}

}  // namespace vpm
