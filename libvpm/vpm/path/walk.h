// The ONE random walk: how every path meets shapes, changes media, flies to events and goes on from them.
#pragma once

#include <cstdint>

#include "vpm/base/counters.h"
#include "vpm/medium/distance/strategy.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// A path under way.
struct PathState {
  Ray ray;
  MediumId medium = kVacuum;
  Rgb throughput{1.0f};  // dimensionless; of photons the power that they carry, W
};

enum class EventKind { collision, surface, limit, escape };

/// What ends a flight. The path's state stands at the event: its ray starts there (at a surface: exactly on it).
struct Event {
  EventKind kind = EventKind::escape;
  Hit hit;                      // at a surface
  float density = 0.0f;         // at a collision
  bool through_medium = false;  // did any part of the flight lead through one?
};

/// What a walk counts.
struct WalkCounters {
  uint64_t lookups = 0;              // of density
  uint64_t bricks = 0;               // of grids, whose bounds were looked up
  uint64_t null_collisions = 0;      // of flights
  uint64_t majorant_violations = 0;  // Flight::majorant_violations
  uint64_t crossings = 0;            // of boundaries between media
  uint64_t medium_mismatches = 0;    // corrections of a path's medium by meet()

  static constexpr auto counters() {
    using W = WalkCounters;
    return std::tuple{
        Counter{"density_lookups", &W::lookups},         Counter{"bricks_crossed", &W::bricks},
        Counter{"null_collisions", &W::null_collisions}, Counter{"majorant_violations", &W::majorant_violations},
        Counter{"boundary_crossings", &W::crossings},    Counter{"met_in_another_medium", &W::medium_mismatches}};
  }
  void merge(const WalkCounters& other) { merge_counters(*this, other); }
};
static_assert(lists_every_member<WalkCounters>());

/// What the ray meets first, with t < t_max. `medium` becomes what the shapes there say it is, and the world's where
/// nothing is met at all: rounding at edges can then not carry a medium astray.
Encounter meet(const Scene& scene, const Ray& ray, float t_max, MediumId& medium, WalkCounters& counters);

/// Passes straight through all boundaries of an encounter: moves the ray's origin just beyond them and enters the
/// medium there.
void cross_boundaries(const Scene& scene, const Encounter& met, Ray& ray, MediumId& medium, WalkCounters& counters);

/// Flies to the next collision in a medium, scattering surface, or out of the scene, through any number of boundaries
/// on the way; at most `limit` metres, > 0. Multiplies the throughput by the flights' weights.
Event next_event(const Scene& scene, const DistanceStrategy& strategy, PathState& state, Rng& rng,
                 WalkCounters& counters, float limit = kInfinity);

/// Russian roulette for paths whose weight, the throughput over that at the start, weighted strategies have made small:
/// they would cost as much as heavy ones. Below 0.1 a path survives with probability weight / 0.1, and its throughput
/// is divided by that. The weight is a magnitude, >= 0. False where the path ends.
bool survive_roulette(double weight, PathState& state, Rng& rng);

/// The outcome of a collision: scatters with probability q = sum(albedo |throughput|) / sum(|throughput|),
/// multiplies the throughput by albedo / q and chooses a new direction; false where the path is absorbed. In grey media
/// the throughput does not change [Jarosz2008, eq. 7.8].
bool scatter_in_medium(const Medium& medium, PathState& state, Rng& rng);

/// Follows a path as the sampled material says, from a surface: plays Russian roulette, surviving with the ratio of
/// largest channels' magnitudes after and before, at most 1. The path goes on from just off the surface, in the medium
/// there. False where absorbed. The throughput is not multiplied by Scatter::radiance_scale, which is for eye paths,
/// nor by flux_scale, which is for photons.
bool go_on_from(const Scene& scene, const Hit& hit, const Scatter& scatter, PathState& state, Rng& rng);

/// The outcome at a surface: samples the material and goes on from there.
bool scatter_at_surface(const Scene& scene, const Hit& hit, PathState& state, Rng& rng, Scatter& scatter);

}  // namespace vpm
