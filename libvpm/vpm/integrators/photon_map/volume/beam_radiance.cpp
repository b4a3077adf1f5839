// Photons near rays, and the transmittance from their projections onto the ray to the eye.
#include "vpm/integrators/photon_map/volume/beam_radiance.h"
#include "vpm/integrators/photon_map/volume/estimators.h"

#include "vpm/estimate/volume_estimate.h"
#include "vpm/integrators/photon_map/check.h"
#include "vpm/integrators/photon_map/volume/bundle_lanes.h"
#include "vpm/integrators/photon_map/volume/pass_to_eye.h"
#include "vpm/photon/stored_power.h"

namespace vpm {
namespace {

/// From the photons near an interval of the ray.
KernelEstimate gather(const EyeSegment& segment, const SegmentRegion& region, const Interval& near, const BeamMap& map,
                      VolumeForm form, const BeamBalance* balance, EyeWork& work) {
  const Medium& medium = *segment.around();
  const BesideRay there(segment.ray, near, region.within(), region.distances());
  const PassToEye pass(medium, medium.homogeneous() ? nullptr : &segment.integrals(work), form, region.mirrored());
  count(work.counters.volume_queries);
  const auto passed = [&](const PhotonsNearRay& photons, Passed& into) {
    const size_t size = photons.batch.size();
    if (!balance) return pass({photons.distance, size}, into);
    float sigma_t[PhotonBatch::kMost];  // at the projections, 1/m
    pass({photons.distance, size}, into, sigma_t);
    for (size_t i = 0; i < size; ++i) {
      const float sine = glm::length(glm::cross(photons.batch.travel(i), segment.ray.direction));
      const float share = balance->of_collisions(sine, sigma_t[i]);
      into.r[i] *= share;
      into.g[i] *= share;
      into.b[i] *= share;
    }
  };
  const BeamSum found = beam_sum(medium.phase, there, passed, map, work.counters.gather);
  const KernelEstimate light = segment.throughput * source_factor(medium) * found.sum;
  if (region.whole() || found.radius == 0.0f) return light;
  const SeenAlong seen(medium.sigma_t, segment.interval, pass.integrals());
  return over_share(light, region.share(found.radius, seen, work.rng), work.counters.gather);
}

LaneTotals sum_beside(const Medium& medium, const BeamMap& map, const GatherLanes& lanes, const BeamBalance* balance,
                      GatherCounters& counters) {
  const float radius = map.settings.radius, norm = kernel_norm_2d(map.settings.kernel, radius);
  LaneTotals totals;
  const Extinction extinction(medium.sigma_t);
  const auto visit = [&](const BundledPhotons& photons) {
    LaneEstimates sums;
    with_phase_and_kernel<2>(medium.phase, map.settings.kernel, [&](const auto& phase, auto profile) {
      const PhotonBeside beside{lanes.segments(), phase, profile, extinction, radius, balance};
      for (size_t p = 0; p < photons.size; ++p) beside.add(photons, p, sums);
    });
    totals.add(sums, norm);
    count(counters.visited, photons.size * lanes.size());
  };
  count(counters.visited, map.photons.visit_near_bundle(lanes.rays(), visit));
  counters.used += totals.used();
  return totals;
}

/// Of up to kBlock segments.
void photons_beside_block(const Vec3& apex, SegmentBundle bundle, const BeamMap& map, VolumeForm form,
                          const BeamBalance* balance) {
  constexpr float kMostRadii = 4.0f;  // wide bundles look at photons that few of their rays use
  const float radius = map.settings.radius;
  if (map.photons.size() == 0) return;
  const auto one_by_one = [&] {
    for (BundledSegment& of : bundle) of.light += photons_beside(*of.segment, map, form, balance, *of.work);
  };
  if (map.settings.beam_count > 0 || !is_narrow(apex, bundle, map.photons.bounds(), radius, kMostRadii))
    return one_by_one();
  GatherLanes lanes(apex, bundle, map.settings, Spread::discs, map.photons.bounds());
  if (!lanes.any()) return;
  if (!lanes.ahead()) return one_by_one();
  EyeCounters& counters = bundle.front().work->counters;
  count(counters.volume_queries, lanes.searching());
  count(counters.gather.searches, lanes.searching());
  const Medium& medium = *bundle.front().segment->around();
  const LaneTotals found = sum_beside(medium, map, lanes, balance, counters.gather);
  lanes.add(found, source_factor(medium));
}

}  // namespace

BeamMap make_beam_map(std::vector<Photon>& photons, const GatherSettings& gather, float shrunk, uint64_t emitted,
                      const PassOfMaps& pass, RenderStatistics& statistics) {
  merge_photons(photons, gather, pass, statistics);
  const auto scale = static_cast<float>(1.0 / static_cast<double>(emitted));
  BeamMap map{gather, SegmentMap(std::exchange(photons, {}), {gather.radius, gather.beam_count, shrunk}, scale)};
  statistics.photon_map_bytes += map.photons.memory_bytes();
  return map;
}

KernelEstimate photons_beside(const EyeSegment& segment, const BeamMap& map, VolumeForm form,
                              const BeamBalance* balance, EyeWork& work) {
  if (map.photons.size() == 0) return {};
  const SegmentRegion region(segment, map.settings, Spread::discs);
  const Interval near = clip(segment.ray, region.reach(), map.photons.bounds(), map.settings.radius);
  return near.empty() ? KernelEstimate() : gather(segment, region, near, map, form, balance, work);
}

void photons_beside_bundle(const Vec3& apex, SegmentBundle bundle, const BeamMap& map, VolumeForm form,
                           const BeamBalance* balance) {
  each_block(bundle, [&](SegmentBundle block) { photons_beside_block(apex, block, map, form, balance); });
}

void BeamRadiance::build(uint64_t emitted, RenderStatistics& statistics) {
  maps_.build(emitted, statistics,
              [&](std::vector<Photon>& photons, const GatherSettings& gather, float shrunk, uint64_t of,
                  RenderStatistics& s) { return make_beam_map(photons, gather, shrunk, of, maps_.pass(), s); });
}

void BeamRadiance::along_bundle(const Vec3& apex, SegmentBundle bundle) const {
  photons_beside_bundle(apex, bundle, maps_[bundle.front().segment->medium], maps_.settings().form, nullptr);
}

KernelEstimate BeamRadiance::along(const EyeSegment& segment, EyeWork& work) const {
  if (!segment.around()) return {};
  return photons_beside(segment, maps_[segment.medium], maps_.settings().form, nullptr, work);
}

namespace {

void describe_own_radii(VolumeSettings& settings, Description& description) {
  Members<AskedGather>(settings, description)
      .add("count", &AskedGather::beam_count, Integers{0, 1'000'000},
           "> 0: each photon has a radius of its own, of a ball of about so many photons, from a hundredth of `radius` "
           "to `radius`");
}

void check_own_radii(const RenderSettings& s, const SceneFacts&) {
  refuse_count_in_blocks(s, s.volume, "integrator.volume.count", "write 0");
}

}  // namespace

extern const VolumeEstimatorInfo kBeamRadiance{
    .name = "beam",
    .summary = "those within the radius of a whole segment of the eye's ray, in one query",
    .along_rays = true,
    .describe = describe_own_radii,
    .check = check_own_radii,
    .make = [](const VolumePlan& plan) -> std::unique_ptr<VolumeEstimator> {
      return std::make_unique<BeamRadiance>(plan.scene, along_rays(plan.settings), plan.pass);
    }};

}  // namespace vpm
