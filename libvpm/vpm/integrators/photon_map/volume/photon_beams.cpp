// L = sum over beams of Phi W(s) sigma_s p T(t) K(distance) / sine of the angle [Jarosz2011].
#include "vpm/integrators/photon_map/volume/photon_beams.h"
#include "vpm/integrators/photon_map/volume/estimators.h"

#include <algorithm>
#include <variant>

#include "vpm/base/settings/setting_error.h"
#include "vpm/estimate/volume_estimate.h"
#include "vpm/integrators/photon_map/check.h"
#include "vpm/integrators/photon_map/volume/bundle_lanes.h"

namespace vpm {

PhotonBeams::PhotonBeams(const Scene& scene, const VolumeSettings& settings, const MediaPass& pass,
                         std::optional<PlaneUse> planes)
    : planes_(planes), beams_(scene, settings, pass, 1, planes), collisions_(scene, settings, pass, 2, !planes) {}

std::vector<MapInfo> PhotonBeams::maps() const {
  MapInfo map = beams_.maps().front();
  const MapInfo collisions = collisions_.maps().front();
  map.media = collisions.media;
  map.media_histories = collisions.media_histories;
  return {map};
}

Recorders PhotonBeams::recorders() {
  Recorders both{beams_.recorder()};
  for (PhotonRecorder* recorder : collisions_.recorders()) both.push_back(recorder);
  return both;
}

void PhotonBeams::build_beside(float kept_planes, uint64_t emitted, RenderStatistics& statistics) {
  collisions_.build(
      emitted, statistics,
      [&](std::vector<Photon>& photons, const GatherSettings& of_pass, float shrunk, uint64_t of, RenderStatistics& s) {
        return make_beam_map(photons, of_pass, shrunk, of, collisions_.pass(), s);
      });
  beams_.build(emitted, statistics,
               [&](MediumId number, const std::vector<PhotonBeam>& beams, const GatherSettings& of_pass, float kept,
                   float scale) {
                 const BeamBalance balance{kept * kernel_size_1d(of_pass.kernel, of_pass.radius),
                                           kernel_size_2d(of_pass.kernel, collisions_[number].settings.radius),
                                           kept_planes};
                 Map map{of_pass, balance, PhotonBeamMap(beams, of_pass.radius, scale), {}};
                 if (planes_ == PlaneUse::combined)
                   for (const PhotonBeam& beam : beams)
                     map.begins.push_back({beam.turned_from.unpack(), beam.scattering_rate});
                 return map;
               });
}

KernelEstimate PhotonBeams::along(const EyeSegment& segment, EyeWork& work) const {
  if (!segment.around()) return {};
  const Map& map = beams_[segment.medium];
  KernelEstimate light = beams_along(segment, map, work);
  light += photons_beside(segment, collisions_[segment.medium], collisions_.settings().form, &map.balance, work);
  return light;
}

KernelEstimate PhotonBeams::beams_along(const EyeSegment& segment, const Map& map, EyeWork& work) const {
  if (map.beams.size() == 0) return {};
  const SegmentRegion region(segment, map.settings, Spread::lines);
  const Interval near = clip(segment.ray, region.reach(), map.beams.bounds(), map.settings.radius);
  return near.empty() ? KernelEstimate() : gather(segment, region, near, map, work);
}

void PhotonBeams::along_bundle(const Vec3& apex, SegmentBundle bundle) const {
  const MediumId medium = bundle.front().segment->medium;
  const Map& map = beams_[medium];
  beams_along_bundle(apex, bundle, map);
  photons_beside_bundle(apex, bundle, collisions_[medium], collisions_.settings().form, &map.balance);
}

void PhotonBeams::beams_along_bundle(const Vec3& apex, SegmentBundle bundle, const Map& map) const {
  constexpr float kMostRadii = 16.0f;  // of blocks: wide ones look at beams that few of their rays cross
  if (map.beams.size() == 0) return;
  const Medium& medium = *bundle.front().segment->around();
  const auto one_by_one = [&](SegmentBundle some) {
    for (BundledSegment& of : some) of.light += beams_along(*of.segment, map, *of.work);
  };
  if (!is_narrow(apex, bundle, map.beams.bounds(), map.settings.radius, 2.0f * kMostRadii)) return one_by_one(bundle);
  EyeWork& work = *bundle.front().work;
  GatherCounters& counters = work.counters.gather;
  count(counters.visited,
        map.beams.select(rays_of(apex, bundle, map.beams.bounds(), map.settings.radius), work.scratch.beams));
  each_block(bundle, [&](SegmentBundle block) {
    GatherLanes lanes(apex, block, map.settings, Spread::lines, map.beams.bounds());
    if (!lanes.any()) return;
    if (!lanes.ahead()) return one_by_one(block);
    count(work.counters.volume_queries, lanes.searching());
    count(counters.searches, lanes.searching());
    lanes.add(sum_in_lanes(medium, map, work.scratch.beams, lanes, counters),
              scattering_of_beams(medium, beams_.settings().form));
  });
}

LaneTotals PhotonBeams::sum_in_lanes(const Medium& medium, const Map& map, const PhotonBeamMap::Selection& near,
                                     const GatherLanes& lanes, GatherCounters& counters) const {
  const float radius = map.settings.radius, norm = kernel_norm_1d(map.settings.kernel, radius);
  const bool long_beams = beams_.settings().length == BeamLength::long_beams;
  LaneTotals totals;
  const Extinction extinction(medium.sigma_t);
  const auto visit = [&](const BundledBeams& beams) {
    LaneEstimates sums;
    with_phase_and_kernel<1>(medium.phase, map.settings.kernel, [&](const auto& phase, auto profile) {
      const BeamAcross across{lanes.segments(), phase, profile, extinction, radius, map.balance, long_beams};
      for (size_t p = 0; p < beams.size; ++p) {
        const Begin begin = map.begins.empty() ? Begin{Vec3(0.0f), 0.0f} : map.begins[beams.beam[p]];
        across.add(beams, p, begin.from, begin.sigma_s, sums);
      }
    });
    totals.add(sums, norm);
    count(counters.visited, beams.size * lanes.size());
  };
  count(counters.visited, near.visit_near_bundle(lanes.rays(), visit));
  counters.used += totals.used();
  return totals;
}

/// Beams beyond the region have no share. Returns how many have one.
size_t PhotonBeams::pass_beams(const EyeSegment& segment, const SegmentRegion& region, const Map& map,
                               const PassToEye& pass, const BeamCrossings& found, Passed& passed, float* share,
                               WalkCounters& counters) const {
  const PlaneDistances distances = region.distances();
  float along[BeamCrossings::kMost], sigma_t[BeamCrossings::kMost];
  for (size_t i = 0; i < found.size; ++i) along[i] = distances.of({found.x[i], found.y[i], found.z[i]});
  pass({along, found.size}, passed, sigma_t);
  for (size_t i = 0; i < found.size; ++i) share[i] = map.balance.of_beams_over_sine(found.sine[i], sigma_t[i]);
  if (!map.begins.empty()) share_with_planes(segment.ray.direction, map, found, share);
  multiply_by_left(*segment.around(), beams_.settings(), segment.ray.origin, found, passed, counters);
  if (region.within().hold_all(found.x, found.y, found.z, found.size)) return found.size;
  size_t within = 0;
  for (size_t i = 0; i < found.size; ++i) {
    const bool holds = region.within().hold({found.x[i], found.y[i], found.z[i]});
    share[i] *= holds ? 1.0f : 0.0f;
    within += holds ? 1 : 0;
  }
  return within;
}

/// The shares of beams whose flights began at collisions.
void PhotonBeams::share_with_planes(const Vec3& ray, const Map& map, const BeamCrossings& found, float* share) const {
  for (size_t i = 0; i < found.size; ++i) {
    const Begin& begin = map.begins[found.beam[i]];
    if (begin.sigma_s == 0.0f) continue;
    const float determinant =
        std::abs(glm::dot(begin.from, glm::cross(Vec3(found.dx[i], found.dy[i], found.dz[i]), ray)));
    share[i] = map.balance.of_beams_beside_planes_over_sine(found.sine[i], begin.sigma_s, determinant);
  }
}

KernelEstimate PhotonBeams::gather(const EyeSegment& segment, const SegmentRegion& region, const Interval& near,
                                   const Map& map, EyeWork& work) const {
  const Medium& medium = *segment.around();
  const float radius = map.settings.radius, inverse = 1.0f / (radius * radius);
  const VolumeForm form = beams_.settings().form;
  const PassToEye pass(medium, medium.homogeneous() ? nullptr : &segment.integrals(work), form, region.mirrored());
  GatherCounters& counters = work.counters.gather;
  count(work.counters.volume_queries);
  count(counters.searches);
  const Vec3 towards_eye = -segment.ray.direction;
  KernelPair<Rgbd> sum;
  const auto visit = [&](const BeamCrossings& found) {
    Passed passed;
    float share[BeamCrossings::kMost];  // over the sine
    counters.used += pass_beams(segment, region, map, pass, found, passed, share, work.counters.walk);
    sum += with_phase_and_kernel<1>(medium.phase, map.settings.kernel, [&](const auto& phase, auto profile) {
      return sum_beams(found, passed, share, phase, towards_eye, profile, inverse);
    });
  };
  count(counters.visited, map.beams.visit_crossings(segment.ray, near, visit));
  const KernelEstimate light =
      segment.throughput * scattering_of_beams(medium, form) * normed(sum, kernel_norm_1d(map.settings.kernel, radius));
  if (region.whole() || is_black(light.value)) return light;
  const SeenAlong seen(medium.sigma_t, segment.interval, pass.integrals());
  return over_share(light, region.share(radius, seen, work.rng), counters);
}

void check_photon_beams(const RenderSettings& s, const SceneFacts& facts) {
  check_flights(s, facts);
  refuse_if(s.photons.in_cube > 0, "integrator.photons.in_cube",
            "where beams cross rays, the collisions near these weigh by their own directions, and must not be merged",
            "write 0, or another 'type' in [integrator.volume]");
}

extern const VolumeEstimatorInfo kPhotonBeams{
    .name = "photon-beams",
    .summary =
        "all flights of photons that pass it within the radius, and the photons near it where flights run along it",
    .along_rays = true,
    .flights = true,
    .describe = describe_flights,
    .check = check_photon_beams,
    .make = [](const VolumePlan& plan) -> std::unique_ptr<VolumeEstimator> {
      return std::make_unique<PhotonBeams>(plan.scene, along_rays(plan.settings), plan.pass);
    }};

}  // namespace vpm
