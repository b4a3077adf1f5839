// The loop of the random walk: it follows a path from event to event and shows each event to a visitor.
//
// A visitor is any object with these members. They are looked up at compile time:
//
// - `bool see(const Event& event, const PathState& from, PathState& at)` is called at every event, the last one
//   included, before its outcome is drawn. `from` is the path at the start of the flight. `at` stands at the event,
//   with the direction and throughput with which the path arrived. False ends the path. see() may change the
//   throughput: this is the place for Russian roulette.
// - `bool scatter(const Scene& scene, const Event& event, PathState& at, Rng& rng)` is called at collisions and
//   surfaces and draws the outcome. It returns false if the path is absorbed. PhotonVisitor and EyeVisitor scatter as
//   unguided photons and paths from the eye do; other visitors may guide the scattering.
// - `float limit(const PathState& from)` is optional: the greatest length of the next flight, m, > 0. A flight
//   that reaches it ends in an event of kind `limit`, from which the path flies on unchanged.
// - `void cut(const PathState& at)` is optional. It is called for a path that has met as many events as it may and
//   would still go on. Without it the rest of the path is dropped, which suits visitors that keep no account of
//   energy.
//
// Photon tracing with splitting can be such a visitor, too. Its limit() is how far the photon may fly before it is
// worth a split. Its see() records the photon, plays roulette and puts copies of the path on a list, with the event and
// the number of events so far. Each copy goes on by a call of the visitor's scatter() and, if that returns true, of
// follow() with that number of events. One stream of random numbers then serves all branches, one after another.
#pragma once

#include <limits>

#include "vpm/path/walk.h"

namespace vpm {

/// The limit of events for paths that end by themselves.
inline constexpr int kNoEventLimit = std::numeric_limits<int>::max();

/// What a walk needs, and the counters that it adds to.
struct Walk {
  const Scene& scene;
  const DistanceStrategy& strategy;
  WalkCounters& counters;
  int max_events = kNoEventLimit;  // of one path
};

/// Follows a path until the visitor ends it, it is absorbed, it escapes, its throughput is 0, or it has met as many
/// events as the walk allows. `events` is the number that it has met before. The path begins with a flight.
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

/// Draws the outcome of an event for a photon: of a collision by scatter_in_medium(), at a surface by
/// scatter_at_surface() and the material's flux_scale. False if the photon is absorbed.
bool scatter_photon(const Scene& scene, const Event& event, PathState& state, Rng& rng);
/// The same for a path from the eye, with the material's radiance_scale.
bool scatter_eye_path(const Scene& scene, const Event& event, PathState& state, Rng& rng);

/// A visitor of a photon's walk that passes events to the function `see`.
template <class See>
struct PhotonVisitor {
  See see;
  static bool scatter(const Scene& scene, const Event& event, PathState& at, Rng& rng) {
    return scatter_photon(scene, event, at, rng);
  }
};
template <class See>
PhotonVisitor(See) -> PhotonVisitor<See>;

/// The same for the walk of a path from the eye.
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
