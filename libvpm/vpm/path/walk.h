// The events of the random walk: how every path meets shapes, changes media, flies to events and goes on from them.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/base/counters.h"
#include "vpm/medium/distance/strategy.h"
#include "vpm/path/segment.h"

namespace vpm {

/// The present state of a path.
struct PathState {
  Ray ray;
  MediumId medium = kVacuum;
  Rgb throughput{1.0f};  // of a path from the eye: dimensionless; of a photon: its power, W
};

/// The part of a flight that leads through one medium: from the ray's origin to the event, or to where the medium ends.
struct Track : Segment {
  float reach = 0.0f;           // m from the ray's origin, to where the medium ends or the flight would have been cut
  double integral = kNotKnown;  // Flight::integral
};

enum class EventKind { collision, surface, limit, escape };

/// What ends a flight. The ray of the path's state then starts at the event, for a surface exactly on it.
struct Event {
  EventKind kind = EventKind::escape;
  Hit hit;                      // at a surface
  float density = 0.0f;         // at a collision
  bool through_medium = false;  // did any part of the flight lead through a medium?
};

/// What a walk counts.
struct WalkCounters {
  uint64_t rays = 0;                 // rays through the scene's surfaces, each to what it meets first
  uint64_t lookups = 0;              // look-ups of density
  uint64_t bricks = 0;               // bricks of density grids whose bounds were looked up
  uint64_t null_collisions = 0;      // null collisions of all flights
  uint64_t majorant_violations = 0;  // Flight::majorant_violations
  uint64_t crossings = 0;            // crossings of boundaries between media
  uint64_t medium_mismatches = 0;    // corrections of a path's medium by meet()

  static constexpr auto counters() {
    using W = WalkCounters;
    return std::tuple{Counter{"rays_traced", &W::rays},
                      Counter{"density_lookups", &W::lookups},
                      Counter{"bricks_crossed", &W::bricks},
                      Counter{"null_collisions", &W::null_collisions},
                      Counter{"majorant_violations", &W::majorant_violations},
                      Counter{"boundary_crossings", &W::crossings},
                      Counter{"met_in_another_medium", &W::medium_mismatches}};
  }
  void merge(const WalkCounters& other) { merge_counters(*this, other); }
};
static_assert(lists_every_member<WalkCounters>());

/// What the ray meets first, with t < t_max. Also corrects `medium`, so that an error from rounding at edges does not
/// last: it becomes the medium in front of the shapes that the ray meets. If the ray meets nothing and t_max is
/// infinite, it becomes the world's medium.
Encounter meet(const Scene& scene, const Ray& ray, float t_max, MediumId& medium, WalkCounters& counters);

/// Takes the ray straight through all boundaries of an encounter: moves its origin just beyond them and sets `medium`
/// to the one there.
void cross_boundaries(const Scene& scene, const Encounter& met, Ray& ray, MediumId& medium, WalkCounters& counters);

/// Flies to the next collision in a medium, to the next surface that is no boundary, or out of the scene. The flight
/// passes any number of boundaries and is at most `limit` metres long, > 0. Multiplies the throughput by the weights
/// that the distance strategy gives the flight. Appends the parts of the flight that lead through media to `tracks`,
/// unless that is null.
Event next_event(const Scene& scene, const DistanceStrategy& strategy, PathState& state, Rng& rng,
                 WalkCounters& counters, float limit = kInfinity, std::vector<Track>* tracks = nullptr);

/// Russian roulette for paths whose weight (a magnitude >= 0: the throughput relative to that at the start) has become
/// small by weighted strategies: such a path costs as much as one of large weight. If the weight is below 0.1, the path
/// survives with probability weight / 0.1, and its throughput is divided by that probability. False if the path ends.
bool survive_roulette(double weight, PathState& state, Rng& rng);

/// Draws the outcome of a collision. The path scatters with probability q = sum(albedo |throughput|) /
/// sum(|throughput|): its throughput is multiplied by albedo / q and a new direction is drawn. False if the path is
/// absorbed. Where the albedo is grey the throughput does not change [Jarosz2008, eq. 7.8].
bool scatter_in_medium(const MediumProperties& here, PathState& state, Rng& rng);

/// Moves a path off a surface along the direction of `scatter`, into the medium there. Leaves its throughput alone.
void leave_along(const Scene& scene, const Hit& hit, const Scatter& scatter, PathState& state);

/// Continues a path from a surface as `scatter` says. Plays Russian roulette: the path survives with probability min(1,
/// m after scattering / m before), with m the magnitude of the throughput's largest channel. The path goes on from just
/// off the surface, in the medium there. False if it is absorbed. The throughput is multiplied neither by
/// Scatter::radiance_scale, which is for paths from the eye, nor by flux_scale, which is for photons.
bool go_on_from(const Scene& scene, const Hit& hit, const Scatter& scatter, PathState& state, Rng& rng);

/// Draws the outcome at a surface: samples the material into `scatter` and calls go_on_from().
bool scatter_at_surface(const Scene& scene, const Hit& hit, PathState& state, Rng& rng, Scatter& scatter);

}  // namespace vpm
