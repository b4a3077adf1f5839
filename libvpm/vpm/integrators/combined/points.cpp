// Photons in media around whole rays from the camera: leaf by leaf around one ray, or photon by photon around many. And
// around where an eye sub-path collides.
#include "vpm/base/counters.h"
#include "vpm/integrators/combined/eye_sub_path.h"
#include "vpm/integrators/combined/merge_light.h"
#include "vpm/photon/stored_power.h"

namespace vpm {
namespace {

// --- Many photons and one ray

/// The medium at the places of a leaf's photons on the ray. Those that are not near have density 0. Returns how many
/// are.
uint32_t set_medium_beside(const Medium& medium, const DensityIntegralsAlong& integrals,
                           const MergeMap::BesideRay& beside, float radius, PhotonsBeside& at) {
  uint32_t number = 0;
  for (size_t i = 0; i < kBlock; ++i) {
    if (!(beside.distances2[i] < radius * radius)) continue;
    at.q.set(i, beside.distances2[i] / (radius * radius));
    float density = 1.0f, seen_integral = beside.places[i];
    if (!medium.homogeneous()) {
      const DensityIntegralsAlong::Place place = integrals.at(beside.places[i]);
      density = static_cast<float>(place.density);
      seen_integral = static_cast<float>(place.integral);
    }
    at.along_ray.set(i, beside.places[i]);
    at.density.set(i, density);
    at.seen_integral.set(i, seen_integral);
    number += density > 0.0f ? 1 : 0;
  }
  return number;
}

template <class PhaseFunction>
void set_photons(const PhotonLeaf& leaf, const PhaseFunction& phase, const Vec3& along, PhotonsBeside& at) {
  at.power = {lanes_of(leaf.power_r), lanes_of(leaf.power_g), lanes_of(leaf.power_b)};
  at.passing = lanes_of(leaf.passing);
  at.adjacent = lanes_of(leaf.adjacent);
  at.further = lanes_of(leaf.further);
  const Floats3 travel = Floats3::of(leaf.travel_x, leaf.travel_y, leaf.travel_z);
  const Floats3 across = cross(along, travel);
  at.sine = sqrt(dot(across, across));
  at.scattered = phase.value(travel, -along);
}

// --- One photon and many rays

/// How a photon lies to the rays of a block.
struct BesideRays {
  LaneMask near;
  Floats distance2, places;  // as MergeMap::BesideRay has them
};
BesideRays beside(const RayBlock& block, const Vec3& photon) {
  const RayLanes& rays = block.lanes;
  const Floats3 place = photon - block.apex - rays.from;
  const Floats t = dot(place, rays.along), a = dot(place, rays.right), b = dot(place, rays.up);
  const Floats distance2 = a * a + b * b;
  return {(distance2 < block.radius * block.radius) & (t >= rays.t0) & (t < rays.t1), distance2, t};
}

/// Photon number `p` of a leaf, and the rays of a block that it is near.
template <class PhaseFunction>
PhotonsBeside photon_beside(const PhotonLeaf& leaf, size_t p, const RayBlock& block, const BesideRays& beside,
                            const PhaseFunction& phase) {
  const Floats3& along = block.lanes.along;
  const Vec3 travel = leaf.travel(p);
  const Floats3 across = cross(travel, along);
  const Floats place = select(beside.near, beside.places, 0.0f);
  return {.power = all_lanes(leaf.power(p)),
          .passing = leaf.passing[p],
          .adjacent = leaf.adjacent[p],
          .further = leaf.further[p],
          .sine = sqrt(dot(across, across)),
          .scattered = phase.value(travel, block.lanes.towards_eye),
          .q = select(beside.near, beside.distance2 * (1.0f / (block.radius * block.radius)), 1.0f),
          .along_ray = place,
          .seen_integral = place,
          .density = select(beside.near, 1.0f, 0.0f)};
}

/// Of one block, among leaves near all of the bundle.
void merge_block_of_points(const CombinedContext& context, const RayBlock& block, EyeWork& work,
                           std::span<Merged> merged) {
  const MediumId medium = block.segments.front().medium;
  const MergeMap& map = context.light.in_medium(medium);
  GatherCounters& counters = work.counters.gather;
  const RayBundle bundle = block.bundle();
  MergedTotals totals;
  const auto merge = [&](const auto& light) {
    for (const uint32_t number : work.scratch.leaves) {
      const PhotonLeaf& leaf = map.leaf(number);
      uint32_t near[kBlock];
      const uint32_t found = find_near(leaf, bundle, block.radius, near);
      count(counters.visited, kBlock + found * merged.size());
      for (uint32_t i = 0; i < found; ++i) {
        const size_t p = near[i];
        const BesideRays lies = beside(block, leaf.point(p));
        const uint32_t used = lanes_in(lies.near);
        if (used == 0) continue;
        count(counters.used, used);
        light.add(block.rays, photon_beside(leaf, p, block, lies, light.phase()), totals.next());
      }
    }
  };
  with_photon_light(context, context.scene.media[medium], merge);
  const std::array<MergedSum, kBlock>& sums = totals.of_lanes();
  for (size_t i = 0; i < merged.size(); ++i) merged[i] = sums[i].times(factor_of_photons(context, block.segments[i]));
}

}  // namespace

Merged merge_points(const CombinedContext& context, const MergeSegment& segment, EyeWork& work) {
  const MergeMap& map = context.light.in_medium(segment.medium);
  if (context.counts.points_2d == 0.0 || map.size() == 0) return {};
  const Medium& medium = context.scene.media[segment.medium];
  const float radius = context.kernels.points_2d;
  const MergingRays rays = rays_of(segment, context.counts.points_2d);
  GatherCounters& counters = work.counters.gather;
  MergedTotals totals;
  const auto merge = [&](const auto& light) {
    const auto visit = [&](const PhotonLeaf& leaf, const MergeMap::BesideRay& beside) {
      PhotonsBeside at;
      count(counters.used, set_medium_beside(medium, work.scratch.integrals, beside, radius, at));
      set_photons(leaf, light.phase(), segment.ray.direction, at);
      light.add(rays, at, totals.next());
    };
    return map.visit_leaves_near_ray(segment.ray, segment.interval, radius, visit);
  };
  count(work.counters.volume_queries);
  count(counters.searches);
  count(counters.visited, with_photon_light(context, medium, merge));
  return totals.of_all().times(factor_of_photons(context, segment));
}

void merge_points(const CombinedContext& context, const Vec3& apex, std::span<const MergeSegment> bundle, EyeWork& work,
                  std::span<Merged> merged) {
  constexpr float kMostRadii = 8.0f;
  const MergeMap& map = context.light.in_medium(bundle.front().medium);
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

// Photons in media around where an eye sub-path collides.
void EyeSubPath::merge_points_3d(const PathVertex& at) {
  const MergeMap& map = c_.light.in_medium(at.medium);
  if (!c_.counts.merges_points_3d(at_.only_specular) || map.size() == 0) return;
  const Medium& medium = c_.scene.media[at.medium];
  const float radius = c_.kernels.points_3d;
  const auto kernel = kernel_of<3>(c_.kernels.volume_kernel, radius);
  // Times the albedo and the relative density over the extinction, m
  Rgb each = at_.state.throughput * (relative_density(medium, at.density) / static_cast<float>(c_.light_paths));
  for (int c = 0; c < 3; ++c) each[c] *= at.sigma_t[c] > 0.0f ? medium.albedo()[c] / at.sigma_t[c] : 0.0f;
  const double scale = c_.light.scale_in(at.medium) * c_.counts.weigh(at.density);
  const double merged = points_3d_merged(c_.counts, at, at_.only_specular);
  count(work_.counters.volume_queries);
  count(work_.counters.gather.searches);
  const auto merge = [&](const MergePhoton& photon, float distance2) {
    const float phase = phase_value(medium.phase, photon.travel, -at.travel);
    const double merges = merges_in_medium(c_.counts, at, photon.passing / at.density, at.leg,
                                           sine_between(photon.travel, at.travel), at_.only_specular);
    const double all = all_at_merge(c_.counts, merges, photon.behind.over(scale), phase, at.behind, phase);
    add_merged(Technique::points_3d, each * photon.power * phase, kernel(distance2), merged / all);
  };
  count(work_.counters.gather.visited, map.visit_near(at.point, radius, merge));
}

}  // namespace vpm
