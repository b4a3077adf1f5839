// Flights between events and what happens at them.
#include "vpm/path/walk.h"

#include "vpm/base/cancel.h"
#include "vpm/base/counters.h"
#include "vpm/medium/distance/mixture.h"
#include "vpm/path/segments.h"
#include "vpm/surface/shading.h"

namespace vpm {
namespace {

/// The visitor of a flight, which escapes unless something else ends it.
struct Flying {
  const Scene& scene;
  const DistanceStrategy& strategy;
  PathState& state;
  Rng& rng;
  WalkCounters& counters;
  std::vector<Track>* tracks;
  Event& event;

  bool pass(float length, const Encounter& met) {
    if (state.medium != kVacuum && collides_within(length)) return false;
    if (!met && length < kInfinity) {
      state.ray.origin = state.ray.at(length);
      event.kind = EventKind::limit;
    }
    return true;
  }

  bool collides_within(float length) {
    event.through_medium = true;
    const Flight flight = strategy.sample(scene.media[state.medium], state.ray, {0.0f, length}, state.throughput, rng);
    count(counters.lookups, flight.lookups);
    count(counters.bricks, flight.bricks);
    count(counters.null_collisions, flight.null_collisions);
    counters.majorant_violations += flight.majorant_violations;
    if (tracks)
      tracks->push_back({{state.ray, {0.0f, flight.t}, state.medium, state.throughput}, length, flight.integral});
    state.throughput *= flight.weight;
    if (!flight.collided) return false;
    state.ray.origin = state.ray.at(flight.t);
    event.kind = EventKind::collision;
    event.density = flight.density;
    return true;
  }
};

}  // namespace

Encounter meet(const Scene& scene, const Ray& ray, float t_max, MediumId& medium, WalkCounters& counters) {
  cancellation_point();
  count(counters.rays);
  Encounter met = scene.geometry.encounter(ray, t_max);
  if (!met && t_max < kInfinity) return met;
  MediumId known = met ? medium_before(scene, met, ray.direction, medium) : scene.world_medium;
  // A grid's box may stand on a floor that names the medium around it: the ray comes to the floor from within the box.
  if (known != medium && met.surface)
    if (const Encounter all = scene.geometry.division(ray)) known = medium_before(scene, all, ray.direction, medium);
  if (known != medium) ++counters.medium_mismatches;
  medium = known;
  return met;
}

void cross_boundaries(const Scene& scene, const Encounter& met, Ray& ray, MediumId& medium, WalkCounters& counters) {
  count(counters.crossings, static_cast<uint64_t>(met.count));
  medium = medium_after(scene, met, ray.direction, medium);
  ray.origin = leave_surfaces(met, ray.direction);
}

Event next_event(const Scene& scene, const DistanceStrategy& strategy, PathState& state, Rng& rng,
                 WalkCounters& counters, float limit, std::vector<Track>* tracks) {
  Event event;
  Flying flying{scene, strategy, state, rng, counters, tracks, event};
  const std::optional<Hit> surface = each_segment(scene, state.ray, state.medium, limit, counters, flying);
  if (!surface) return event;
  state.ray.origin = surface->position;
  event.kind = EventKind::surface;
  event.hit = *surface;
  return event;
}

bool survive_roulette(double weight, PathState& state, Rng& rng) {
  constexpr double kBelow = 0.1;
  if (weight >= kBelow) return true;
  const double survival = weight / kBelow;
  if (!(rng.uniform_double() < survival)) return false;
  state.throughput /= static_cast<float>(survival);
  return true;
}

bool scatter_in_medium(const MediumProperties& here, PathState& state, Rng& rng) {
  const Rgb albedo = here.albedo();
  const float q = is_grey(albedo) ? albedo.r : glm::dot(albedo, channel_shares(state.throughput));
  if (rng.uniform() >= q) return false;
  if (!is_grey(albedo)) state.throughput *= albedo / q;
  state.ray.direction = phase_sample(here.phase, state.ray.direction, rng.uniform2());
  return true;
}

void leave_along(const Scene& scene, const Hit& hit, const Scatter& scatter, PathState& state) {
  if (scatter.transmitted)
    state.medium = medium_beyond(scene.shapes[hit.shape], hit.normal, scatter.direction, state.medium);
  state.ray = {leave_surface(hit, scatter.direction), scatter.direction};
}

bool go_on_from(const Scene& scene, const Hit& hit, const Scatter& scatter, PathState& state, Rng& rng) {
  const Rgb after = state.throughput * scatter.weight;
  const float survival = std::min(1.0f, max_channel(glm::abs(after)) / max_channel(glm::abs(state.throughput)));
  if (!(rng.uniform() < survival)) return false;
  state.throughput = after / survival;
  leave_along(scene, hit, scatter, state);
  return true;
}

bool scatter_at_surface(const Scene& scene, const Hit& hit, PathState& state, Rng& rng, Scatter& scatter) {
  const float choice = rng.uniform();
  scatter = sample_scatter(material_at(scene, hit), hit, state.ray.direction, choice, rng.uniform2());
  return go_on_from(scene, hit, scatter, state, rng);
}

}  // namespace vpm
