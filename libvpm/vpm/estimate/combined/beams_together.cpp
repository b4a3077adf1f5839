// The same flights and many rays that lie side by side: one search for all of them, and each beam taken to kBlock of
// them at once.
#include "vpm/base/count.h"
#include "vpm/estimate/combined/crossing_light.h"
#include "vpm/photon/ray_lanes.h"

namespace vpm {
namespace {

using Directions = std::array<Vec3, kEyeRays>;
std::span<const Vec3> directions_of(std::span<const RaySegment> bundle, Directions& directions) {
  for (size_t i = 0; i < bundle.size(); ++i) directions[i] = bundle[i].ray.direction;
  return {directions.data(), bundle.size()};
}

/// The part of the segments of a bundle that beams may cross, m from its apex; empty where there is none.
Interval reach_of(const LightBeams& beams, std::span<const RaySegment> bundle, const Vec3& apex, float radius) {
  Interval reach{kInfinity, 0.0f};
  for (const RaySegment& segment : bundle) {
    const Interval near = near_beams(beams, segment, radius);
    if (near.empty()) continue;
    const float before = glm::distance(apex, segment.ray.origin);
    reach = {std::min(reach.t0, before + near.t0), std::max(reach.t1, before + near.t1)};
  }
  return reach;
}

/// The sums of rays, in doubles.
struct RayTotals {
  std::array<Rgbd, kBlock> value{}, correction{}, unweighted{};

  void add(const CrossingSums& sums) {
    for (size_t lane = 0; lane < kBlock; ++lane)
      for (int c = 0; c < 3; ++c) {
        value[lane][c] += sums.value[c][lane];
        correction[lane][c] += sums.correction[c][lane];
        unweighted[lane][c] += sums.unweighted[c][lane];
      }
  }
};

/// Up to kBlock rays of a bundle.
struct RaysAcrossBeams {
  const LightBeams& beams;
  RayLanes lanes;
  MergingRays merging;
  Vec3 apex;
  float radius;  // m
};

/// The crossings of piece number `p` with the rays. Returns how many there are.
template <class PhaseFunction>
uint32_t set_crossings(const RaysAcrossBeams& rays, const PhaseFunction& phase, const BundledBeams& found, size_t p,
                       Crossings& at) {
  const CrossingLanes crossing = cross(found, p, rays.lanes, rays.radius);
  if (!any(crossing.met)) return 0;
  const FlightTerms& flight = rays.beams.flights[found.beam[p]];
  const Vec3 travel(found.dx[p], found.dy[p], found.dz[p]);
  uint32_t number = 0;
  for (size_t lane = 0; lane < kBlock; ++lane) number += crossing.met[lane] ? 1 : 0;
  const auto where_met = [&](const Floats& x, float otherwise) { return crossing.met ? x : all_lanes(otherwise); };
  const Floats s = where_met(max(crossing.s, Floats{}), 0.0f), flown = flight.offset + s;
  const Rgb power(found.r[p], found.g[p], found.b[p]);
  for (int c = 0; c < 3; ++c) at.power[c] = where_met(all_lanes(power[c]), 0.0f);
  at.before = all_lanes(flight.before);
  at.back = all_lanes(flight.back);
  at.turn = {all_lanes(flight.turn.x), all_lanes(flight.turn.y), all_lanes(flight.turn.z)};
  at.adjacent = all_lanes(flight.adjacent);
  if (flight.round)
    for (size_t lane = 0; lane < kBlock; ++lane)
      if (crossing.met[lane])
        at.adjacent[lane] =
            adjacent_at(flight, rays.apex + rays.lanes.from[lane] + crossing.places[lane], travel, flown[lane]);
  if (!flight.parallel) at.adjacent *= flown * flown;
  for (size_t lane = 0; lane < kBlock; ++lane) at.scattered[lane] = phase.value(travel, -rays.merging.along[lane]);
  at.sine = where_met(sqrt(crossing.sine2), 1.0f);
  at.q = where_met(min(crossing.distance2 * (1.0f / (rays.radius * rays.radius)), all_lanes(1.0f)), 1.0f);
  at.along_ray = at.seen_integral = where_met(dot(crossing.places, rays.merging.along), 0.0f);
  at.flown_integral = s;
  return number;
}

/// Of up to kBlock segments that lie side by side, among pieces near all of the bundle.
void merge_block(const CombinedContext& context, Technique technique, const Vec3& apex,
                 std::span<const RaySegment> block, EyeWork& work, std::span<Merged> merged) {
  const LightBeams& beams = context.light.beams(technique, block.front().medium);
  const float radius = context.kernels.beams;
  const Interval reach = reach_of(beams, block, apex, radius);
  if (reach.empty()) return;
  RaysAcrossBeams rays{beams, {}, {}, apex, radius};
  for (size_t i = 0; i < block.size(); ++i) {
    rays.lanes.set(i, block[i].ray, near_beams(beams, block[i], radius), apex);
    rays.merging.set(context.counts, i, block[i]);
  }
  GatherCounters& counters = work.counters.gather;
  RayTotals totals;
  const auto merge = [&](const auto& light) {
    const auto visit = [&](const BundledBeams& found) {
      CrossingSums sums;
      for (size_t p = 0; p < found.size; ++p) {
        Crossings at;
        const uint32_t number = set_crossings(rays, light.phase(), found, p, at);
        if (number == 0) continue;
        count(counters.used, number);
        light.add(rays.merging, at, sums);
      }
      totals.add(sums);
      count(counters.visited, found.size * block.size());
    };
    Directions directions;
    return work.scratch.beams.visit_near_bundle({apex, directions_of(block, directions), reach.t1 + radius}, visit);
  };
  count(counters.visited, with_crossing_light(context, technique, context.scene.media[block.front().medium], merge));
  for (size_t i = 0; i < block.size(); ++i) {
    const Rgb factor = factor_of(context, block[i]);
    merged[i] = {{Rgb(totals.value[i]) * factor, Rgb(totals.correction[i]) * factor},
                 Rgb(totals.unweighted[i]) * factor};
  }
}

}  // namespace

void merge_beams(const CombinedContext& context, Technique technique, const Vec3& apex,
                 std::span<const RaySegment> bundle, EyeWork& work, std::span<Merged> merged) {
  constexpr float kMostRadii = 32.0f;  // of bundles: wide ones look at beams that few of their rays cross
  const LightBeams& beams = context.light.beams(technique, bundle.front().medium);
  if (beams.map.size() == 0) return;
  const float radius = context.kernels.beams;
  const float free_path = 1.0f / mean_channel(context.scene.media[bundle.front().medium].sigma_t);
  const Interval reach = reach_of(beams, bundle, apex, radius);
  if (reach.empty()) return;
  Directions directions;
  const std::span<const Vec3> all = directions_of(bundle, directions);
  if (!is_narrow(all, reach, free_path, kMostRadii * radius)) {
    for (size_t i = 0; i < bundle.size(); ++i) merged[i] = merge_beams(context, technique, bundle[i], work);
    return;
  }
  GatherCounters& counters = work.counters.gather;
  count(work.counters.volume_queries, bundle.size());
  count(counters.searches, bundle.size());
  count(counters.visited, beams.map.select({apex, all, reach.t1 + radius}, work.scratch.beams));
  for (size_t first = 0; first < bundle.size(); first += kBlock) {
    const size_t size = std::min<size_t>(kBlock, bundle.size() - first);
    merge_block(context, technique, apex, bundle.subspan(first, size), work, merged.subspan(first, size));
  }
}

}  // namespace vpm
