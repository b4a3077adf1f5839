// Photons in media around whole rays from the camera: leaf by leaf around one ray, or photon by photon around many.
#include <cstring>

#include "vpm/base/count.h"
#include "vpm/estimate/combined/photon_light.h"

namespace vpm {
namespace {

using PhotonsInMedium = VertexMap<MediumPhotonLeaf>;

Floats row(const float (&values)[kBlock]) {
  Floats lanes;
  std::memcpy(&lanes, values, sizeof lanes);
  return lanes;
}

// --- Many photons and one ray

/// The medium at the places of a leaf's photons on the ray. Those that are not near have density 0. Returns how many
/// are.
uint32_t set_medium_beside(const Medium& medium, const DensityIntegralsAlong& integrals,
                           const PhotonsInMedium::BesideRay& beside, float radius, PhotonsBeside& at) {
  uint32_t number = 0;
  for (size_t i = 0; i < kBlock; ++i) {
    if (!(beside.distances2[i] < radius * radius)) continue;
    at.q[i] = beside.distances2[i] / (radius * radius);
    at.along_ray[i] = at.seen_integral[i] = beside.places[i];
    at.density[i] = 1.0f;
    if (!medium.homogeneous()) {
      const DensityIntegralsAlong::Place place = integrals.at(beside.places[i]);
      at.density[i] = static_cast<float>(place.density);
      at.seen_integral[i] = static_cast<float>(place.integral);
    }
    number += at.density[i] > 0.0f ? 1 : 0;
  }
  return number;
}

template <class PhaseFunction>
void set_photons(const MediumPhotonLeaf& leaf, const PhaseFunction& phase, const Vec3& along, PhotonsBeside& at) {
  at.power = {row(leaf.power_r), row(leaf.power_g), row(leaf.power_b)};
  at.passing = row(leaf.passing);
  at.sent = row(leaf.sent);
  at.adjacent = row(leaf.adjacent);
  at.further = row(leaf.further);
  const Floats3 travel{row(leaf.travel_x), row(leaf.travel_y), row(leaf.travel_z)};
  const Floats3 across = cross(along, travel);
  at.sine = sqrt(dot(across, across));
  at.determinant = abs(dot(along, Floats3{row(leaf.turn_x), row(leaf.turn_y), row(leaf.turn_z)}));
  for (size_t i = 0; i < kBlock; ++i) at.scattered[i] = phase.value(leaf.travel(i), -along);
}

// --- One photon and many rays

/// Photon number `p` of a leaf beside the rays of a block. Returns beside how many of them it lies.
template <class PhaseFunction>
uint32_t set_photon(const MediumPhotonLeaf& leaf, size_t p, const RayBlock& block, const PhaseFunction& phase,
                    PhotonsBeside& at) {
  const RayLanes& rays = block.lanes;
  const Floats3 place = Vec3(leaf.x[p], leaf.y[p], leaf.z[p]) - block.apex - rays.from;
  const Floats t = dot(place, rays.along), a = dot(place, rays.right), b = dot(place, rays.up);
  const Floats distance2 = a * a + b * b;
  const LaneMask near = (distance2 < block.radius * block.radius) & (t >= rays.t0) & (t < rays.t1);
  if (!any(near)) return 0;
  uint32_t number = 0;
  for (size_t lane = 0; lane < kBlock; ++lane) number += near[lane] ? 1 : 0;
  at.power = all_lanes(leaf.power(p));
  at.passing = all_lanes(leaf.passing[p]);
  at.sent = all_lanes(leaf.sent[p]);
  at.adjacent = all_lanes(leaf.adjacent[p]);
  at.further = all_lanes(leaf.further[p]);
  const Floats3 across = cross(leaf.travel(p), rays.along);
  at.sine = sqrt(dot(across, across));
  at.determinant = abs(dot(leaf.turn(p), rays.along));
  for (size_t lane = 0; lane < kBlock; ++lane) at.scattered[lane] = phase.value(leaf.travel(p), -rays.along[lane]);
  at.q = near ? distance2 * (1.0f / (block.radius * block.radius)) : all_lanes(1.0f);
  at.along_ray = at.seen_integral = near ? t : Floats{};
  at.density = near ? all_lanes(1.0f) : Floats{};
  return number;
}

/// Of one block, among leaves near all of the bundle.
void merge_block_of_points(const CombinedContext& context, const RayBlock& block, EyeWork& work,
                           std::span<Merged> merged) {
  const MediumId medium = block.segments.front().medium;
  const PhotonsInMedium& map = context.light.in_medium(medium);
  GatherCounters& counters = work.counters.gather;
  std::array<MergedSum, kBlock> totals;
  const auto merge = [&](const auto& light) {
    for (const uint32_t leaf : work.scratch.leaves) {
      LaneMerges sums;
      for (size_t p = 0; p < kBlock; ++p) {
        PhotonsBeside at;
        const uint32_t number = set_photon(map.leaf(leaf), p, block, light.phase(), at);
        if (number == 0) continue;
        count(counters.used, number);
        light.add(block.rays, at, sums);
      }
      for (size_t i = 0; i < merged.size(); ++i) totals[i].add(sums, i);
      count(counters.visited, kBlock * merged.size());
    }
  };
  with_photon_light(context, context.scene.media[medium], merge);
  for (size_t i = 0; i < merged.size(); ++i) merged[i] = totals[i].times(factor_of_photons(context, block.segments[i]));
}

}  // namespace

Merged merge_points(const CombinedContext& context, const RaySegment& segment, EyeWork& work) {
  const PhotonsInMedium& map = context.light.in_medium(segment.medium);
  if (context.counts.points_2d == 0.0 || map.size() == 0) return {};
  const Medium& medium = context.scene.media[segment.medium];
  const float radius = context.kernels.points_2d;
  const MergingRays rays = rays_of(segment, context.counts.points_2d);
  GatherCounters& counters = work.counters.gather;
  MergedSum total;
  const auto merge = [&](const auto& light) {
    const auto visit = [&](const MediumPhotonLeaf& leaf, const PhotonsInMedium::BesideRay& beside) {
      PhotonsBeside at;
      count(counters.used, set_medium_beside(medium, work.scratch.integrals, beside, radius, at));
      set_photons(leaf, light.phase(), segment.ray.direction, at);
      LaneMerges sums;
      light.add(rays, at, sums);
      total.add_all(sums);
    };
    return map.visit_leaves_near_ray(segment.ray, segment.interval, radius, visit);
  };
  count(work.counters.volume_queries);
  count(counters.searches);
  count(counters.visited, with_photon_light(context, medium, merge));
  return total.times(factor_of_photons(context, segment));
}

void merge_points(const CombinedContext& context, const Vec3& apex, std::span<const RaySegment> bundle, EyeWork& work,
                  std::span<Merged> merged) {
  constexpr float kMostRadii = 8.0f;
  const PhotonsInMedium& map = context.light.in_medium(bundle.front().medium);
  if (context.counts.points_2d == 0.0 || map.size() == 0) return;
  const float free_path = 1.0f / mean_channel(context.scene.media[bundle.front().medium].sigma_t);
  std::vector<uint32_t>& leaves = work.scratch.leaves;
  const auto select = [&](const RayBundle& rays) {
    count(work.counters.volume_queries, bundle.size());
    count(work.counters.gather.searches, bundle.size());
    leaves.clear();
    map.visit_leaves(rays, [&](uint32_t leaf) { leaves.push_back(leaf); });
  };
  const auto merge = [&](const RayBlock& block, std::span<Merged> of) {
    merge_block_of_points(context, block, work, of);
  };
  const SearchedMap searched{map.bounds(), context.kernels.points_2d, kMostRadii, context.counts.points_2d};
  if (merge_together(searched, free_path, apex, bundle, merged, select, merge)) return;
  for (size_t i = 0; i < bundle.size(); ++i) merged[i] = merge_points(context, bundle[i], work);
}

}  // namespace vpm
