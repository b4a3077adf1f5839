// Flights of photons that cross whole rays from the camera: with one ray, or with many that lie side by side.
#include "vpm/base/counters.h"
#include "vpm/integrators/combined/merge_light.h"

namespace vpm {
namespace {

/// Beams, and a ray that they cross.
struct CrossedRay {
  const Medium& medium;
  const LightBeams& beams;
  const DensityIntegralsAlong& integrals;
  Ray ray;
  float radius;  // m
  WalkCounters& counters;
};

/// The medium there. False where there is nothing to scatter.
bool set_medium(const CrossedRay& crossed, const Ray& beam, const Vec3& place, float s, float t, size_t lane,
                Crossings& at) {
  const Medium& medium = crossed.medium;
  at.along_ray.set(lane, t);
  if (medium.homogeneous()) {
    at.seen_integral.set(lane, t);
    at.flown_integral.set(lane, s);
    return true;
  }
  const float density = medium.density(place);
  count(crossed.counters.lookups);
  if (density == 0.0f) return false;
  const DensityIntegral flown = density_integral(medium, beam, {0.0f, s});
  count(crossed.counters.lookups, flown.lookups);
  at.density.set(lane, density);
  at.seen_integral.set(lane, static_cast<float>(crossed.integrals.at(t).integral));
  at.flown_integral.set(lane, static_cast<float>(flown.value));
  return true;
}

void set_flight(const FlightTerms& flight, const Rgb& power, size_t lane, Crossings& at) {
  for (int c = 0; c < 3; ++c) {
    at.power[c].set(lane, power[c]);
    at.before[c].set(lane, flight.before[c]);
    at.back[c].set(lane, flight.back[c]);
  }
}

/// Up to kBlock crossings of those found, from number `first` on. Returns how many scatter.
template <class PhaseFunction>
uint32_t set_crossings(const CrossedRay& crossed, const PhaseFunction& phase, const BeamCrossings& found, size_t first,
                       Crossings& at) {
  uint32_t number = 0;
  for (size_t lane = 0; lane < std::min<size_t>(kBlock, found.size - first); ++lane) {
    const size_t n = first + lane;
    const FlightTerms& flight = crossed.beams.flights[found.beam[n]];
    const Vec3 travel(found.dx[n], found.dy[n], found.dz[n]);
    const Vec3 place = crossed.ray.origin + Vec3(found.x[n], found.y[n], found.z[n]);
    const float s = std::max(0.0f, found.s[n]), flown = flight.offset + s;
    if (!set_medium(crossed, {place - s * travel, travel}, place, s, found.t[n], lane, at)) continue;
    ++number;
    set_flight(flight, Rgb(found.r[n], found.g[n], found.b[n]), lane, at);
    at.adjacent.set(lane, adjacent_at(flight, place, travel, flown) * (flight.parallel ? 1.0f : flown * flown));
    at.scattered.set(lane, phase.value(travel, -crossed.ray.direction));
    at.sine.set(lane, found.sine[n]);
    at.q.set(lane, std::min(found.distance2[n] / (crossed.radius * crossed.radius), 1.0f));
  }
  return number;
}

}  // namespace

Merged merge_beams(const CombinedContext& context, const MergeSegment& segment, EyeWork& work) {
  const LightBeams& beams = context.light.beams(segment.medium);
  if (beams.map.size() == 0) return {};
  const float radius = context.kernels.beams;
  count(work.counters.volume_queries);
  count(work.counters.gather.searches);
  const Interval near = clip(segment.ray, segment.interval, beams.map.bounds(), radius);
  if (near.empty()) return {};
  const Medium& medium = context.scene.media[segment.medium];
  const CrossedRay crossed{medium, beams, work.scratch.integrals, segment.ray, radius, work.counters.walk};
  const MergingRays rays = rays_of(segment, context.counts.short_beams);
  MergedTotals totals;
  const auto merge = [&](const auto& light) {
    return beams.map.visit_crossings(segment.ray, near, [&](const BeamCrossings& found) {
      for (size_t first = 0; first < found.size; first += kBlock) {
        Crossings at;
        count(work.counters.gather.used, set_crossings(crossed, light.phase(), found, first, at));
        light.add(rays, at, totals.next());
      }
    });
  };
  count(work.counters.gather.visited, with_crossing_light(context, medium, merge));
  return totals.of_all().times(factor_of(context, segment));
}

// The same flights and many rays that lie side by side: one search for all of them, and each beam taken to kBlock of
// them at once.
namespace {

/// The crossings of piece number `p` with the rays. Returns how many there are.
template <class PhaseFunction>
uint32_t set_crossings(const LightBeams& beams, const RayBlock& block, const PhaseFunction& phase,
                       const BundledBeams& found, size_t p, Crossings& at) {
  const CrossingLanes crossing = cross(found, p, block.lanes, block.radius);
  if (!any(crossing.met)) return 0;
  const FlightTerms& flight = beams.flights[found.beam[p]];
  const Vec3 travel(found.dx[p], found.dy[p], found.dz[p]);
  const auto where_met = [&](const Floats& x, float otherwise) { return select(crossing.met, x, otherwise); };
  const Floats s = where_met(max(crossing.s, Floats{}), 0.0f), flown = flight.offset + s;
  const Rgb power(found.r[p], found.g[p], found.b[p]);
  for (int c = 0; c < 3; ++c) at.power[c] = where_met(power[c], 0.0f);
  at.before = all_lanes(flight.before);
  at.back = all_lanes(flight.back);
  at.adjacent = flight.adjacent;
  if (flight.round)
    for (size_t lane = 0; lane < kBlock; ++lane)
      if (crossing.met[lane])
        at.adjacent.set(lane, adjacent_at(flight, block.apex + block.lanes.from[lane] + crossing.places[lane], travel,
                                          flown[lane]));
  if (!flight.parallel) at.adjacent *= flown * flown;
  at.scattered = phase.value(travel, block.lanes.towards_eye);
  at.sine = where_met(sqrt(crossing.sine2), 1.0f);
  at.q = where_met(min(crossing.distance2 * (1.0f / (block.radius * block.radius)), 1.0f), 1.0f);
  at.along_ray = at.seen_integral = where_met(dot(crossing.places, block.rays.along), 0.0f);
  at.flown_integral = s;
  return lanes_in(crossing.met);
}

/// Of one block, among pieces near all of the bundle.
void merge_block(const CombinedContext& context, const RayBlock& block, EyeWork& work, std::span<Merged> merged) {
  const MediumId medium = block.segments.front().medium;
  const LightBeams& beams = context.light.beams(medium);
  GatherCounters& counters = work.counters.gather;
  MergedTotals totals;
  const auto merge = [&](const auto& light) {
    return work.scratch.beams.visit_near_bundle(block.bundle(), [&](const BundledBeams& found) {
      for (size_t p = 0; p < found.size; ++p) {
        Crossings at;
        const uint32_t number = set_crossings(beams, block, light.phase(), found, p, at);
        if (number == 0) continue;
        count(counters.used, number);
        light.add(block.rays, at, totals.next());
      }
      count(counters.visited, found.size * merged.size());
    });
  };
  count(counters.visited, with_crossing_light(context, context.scene.media[medium], merge));
  const std::array<MergedSum, kBlock>& sums = totals.of_lanes();
  for (size_t i = 0; i < merged.size(); ++i) merged[i] = sums[i].times(factor_of(context, block.segments[i]));
}

}  // namespace

void merge_beams(const CombinedContext& context, const Vec3& apex, std::span<const MergeSegment> bundle, EyeWork& work,
                 std::span<Merged> merged) {
  constexpr float kMostRadii = 32.0f;
  const LightBeams& beams = context.light.beams(bundle.front().medium);
  if (beams.map.size() == 0) return;
  const float free_path = 1.0f / mean_channel(context.scene.media[bundle.front().medium].sigma_t);
  GatherCounters& counters = work.counters.gather;
  const auto select = [&](const RayBundle& rays) {
    count(work.counters.volume_queries, bundle.size());
    count(counters.searches, bundle.size());
    count(counters.visited, beams.map.select(rays, work.scratch.beams));
  };
  const auto merge = [&](const RayBlock& block, std::span<Merged> of) { merge_block(context, block, work, of); };
  const SearchedMap map{beams.map.bounds(), context.kernels.beams, kMostRadii, context.counts.short_beams};
  if (merge_together(map, free_path, apex, bundle, merged, select, merge)) return;
  for (size_t i = 0; i < bundle.size(); ++i) merged[i] = merge_beams(context, bundle[i], work);
}

}  // namespace vpm
