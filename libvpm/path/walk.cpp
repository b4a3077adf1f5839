// Flights between events and what happens at them.
#include "path/walk.h"

#include "medium/distance/mixture.h"

namespace vpm {

std::optional<Hit> meet(const Scene& scene, const Ray& ray, float t_max, MediumId& medium, WalkCounters& counters) {
  std::optional<Hit> hit = scene.geometry.intersect(ray, t_max);
  if (hit && is_boundary(scene.material_of(*hit))) {
    if (const std::optional<Hit> surface = scene.geometry.surface_at(*hit, ray)) hit = surface;
  }
  if (!hit && t_max < kInfinity) return hit;
  const MediumId known = hit ? medium_beyond(scene.shapes[hit->shape], hit->normal, -ray.direction, medium) : scene.world_medium;
  if (known != medium) ++counters.medium_mismatches;
  medium = known;
  return hit;
}

void cross_boundary(const Scene& scene, const Hit& hit, Ray& ray, MediumId& medium, WalkCounters& counters) {
  ++counters.crossings;
  medium = medium_beyond(scene.shapes[hit.shape], hit.normal, ray.direction, medium);
  ray.origin = leave_surface(hit, ray.direction);
}

Event next_event(const Scene& scene, const DistanceStrategy& strategy, PathState& state, Rng& rng, WalkCounters& counters) {
  for (;;) {
    const std::optional<Hit> hit = meet(scene, state.ray, kInfinity, state.medium, counters);
    if (state.medium != kVacuum) {
      const Medium& medium = scene.media[state.medium];
      const Interval free{0.0f, hit ? hit->t : kInfinity};
      const Flight flight = strategy.sample(medium, state.ray, free, state.power, rng);
      counters.lookups += flight.lookups;
      state.power *= flight.weight;
      if (flight.collided) {
        state.ray.origin = state.ray.at(flight.t);
        return {EventKind::collision, {}, flight.density};
      }
    }
    if (!hit) return {EventKind::escape, {}, 0.0f};
    if (!is_boundary(scene.material_of(*hit))) {
      state.ray.origin = hit->position;
      return {EventKind::surface, *hit, 0.0f};
    }
    cross_boundary(scene, *hit, state.ray, state.medium, counters);
  }
}

bool scatter_in_medium(const Medium& medium, PathState& state, Rng& rng) {
  const Rgb albedo = medium.albedo();
  const float q = is_grey(albedo) ? albedo.r : glm::dot(albedo, channel_shares(state.power));
  if (rng.uniform() >= q) return false;
  if (!is_grey(albedo)) state.power *= albedo / q;
  state.ray.direction = phase_sample(medium.phase, state.ray.direction, rng.uniform2());
  return true;
}

bool scatter_at_surface(const Scene& scene, const Hit& hit, PathState& state, Rng& rng, Scatter& scatter) {
  const float choice = rng.uniform();
  scatter = sample_scatter(scene.material_of(hit), hit.normal, state.ray.direction, choice, rng.uniform2());
  const Rgb after = state.power * scatter.weight;
  const float survival = std::min(1.0f, max_channel(after) / max_channel(state.power));
  if (!(rng.uniform() < survival)) return false;
  state.power = after / survival;
  if (scatter.transmitted) state.medium = medium_beyond(scene.shapes[hit.shape], hit.normal, scatter.direction, state.medium);
  state.ray = {leave_surface(hit, scatter.direction), scatter.direction};
  return true;
}

}  // namespace vpm
