// The loop of the ONE random walk: a path from event to event, each of them shown to a visitor.
//
// A visitor is any object with these members, all of them found when the program is compiled:
//
// - `bool see(const Event& event, const PathState& from, PathState& at)`, at every event, the last one included, before
//   its outcome is drawn. `from` is the path as it set out on the flight, `at` stands at the event with the direction
//   and throughput with which it arrived. False ends the path. It may change the throughput: roulette is played here.
// - `bool scatter(const Scene& scene, const Event& event, PathState& at, Rng& rng)`, at collisions and surfaces: draws
//   the outcome. False where the path is absorbed. PhotonVisitor and EyeVisitor scatter as all photons and all paths
//   from the eye do, others may be guided.
// - `float limit(const PathState& from)`, if the visitor has it: how far the next flight may lead, m, > 0. A flight
// that
//   ends there is an event of kind `limit`, from which the path flies on as it is.
// - `void cut(const PathState& at)`, if the visitor has it: `at` has met all the events that a path may meet, and would
//   go on. Without it the rest of the path is dropped: for visitors that tell whoever asks nothing about energy.
//
// Photon tracing with splitting can be such a visitor, too: limit() is how far the photon may fly before it is worth a
// split; see() leaves traces, plays roulette and puts copies of the path, with its event and the number of events so
// far, on a list; each of them goes on by a call of the visitor's scatter() and, where that is true, of follow() with
// that number of events. One stream of random numbers then serves all branches, one after another.
#pragma once

#include <limits>

#include "vpm/path/walk.h"

namespace vpm {

/// Of events, for paths that come to an end by themselves.
inline constexpr int kNoLimit = std::numeric_limits<int>::max();

/// What a walk goes by, and what it counts.
struct Walk {
  const Scene& scene;
  const DistanceStrategy& strategy;
  WalkCounters& counters;
  int max_events = kNoLimit;  // of one path
};

/// Follows a path until the visitor ends it, or it is absorbed, escapes, has a throughput of 0 or met as many events as
/// the walk allows, of which it has met `events` before. It flies first.
template <class Visitor>
void follow(const Walk& walk, PathState state, Rng& rng, Visitor&& visitor, int events = 0) {
  for (; events < walk.max_events; ++events) {
    float limit = kInfinity;
    if constexpr (requires { visitor.limit(state); }) limit = visitor.limit(state);
    const PathState from = state;
    const Event event = next_event(walk.scene, walk.strategy, state, rng, walk.counters, limit);
    if (!visitor.see(event, from, state) || event.kind == EventKind::escape || is_black(state.throughput)) return;
    if (event.kind == EventKind::limit) continue;
    if (!visitor.scatter(walk.scene, event, state, rng)) return;
  }
  if constexpr (requires { visitor.cut(state); }) visitor.cut(state);
}

/// The outcome of a collision or at a surface, for photons: by scatter_in_medium(), or by scatter_at_surface() and the
/// material's flux_scale. False where absorbed.
bool scatter_photon(const Scene& scene, const Event& event, PathState& state, Rng& rng);
/// The same for paths from the eye: with the material's radiance_scale.
bool scatter_eye_path(const Scene& scene, const Event& event, PathState& state, Rng& rng);

/// Shows a photon's walk to a function, which is the visitor's see().
template <class See>
struct PhotonVisitor {
  See see;
  static bool scatter(const Scene& scene, const Event& event, PathState& at, Rng& rng) {
    return scatter_photon(scene, event, at, rng);
  }
};
template <class See>
PhotonVisitor(See) -> PhotonVisitor<See>;

/// Shows the walk of a path from the eye to a function.
template <class See>
struct EyeVisitor {
  See see;
  static bool scatter(const Scene& scene, const Event& event, PathState& at, Rng& rng) {
    return scatter_eye_path(scene, event, at, rng);
  }
};
template <class See>
EyeVisitor(See) -> EyeVisitor<See>;

}  // namespace vpm
