// L = integral over t of the sum over beams of Phi W(s) sigma_s p T K(distance from the beam) [Jarosz2011].
#include "vpm/integrators/photon_map/volume/beams_around_points.h"
#include "vpm/integrators/photon_map/volume/estimators.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "vpm/estimate/march.h"
#include "vpm/estimate/volume_estimate.h"
#include "vpm/integrators/photon_map/check.h"

namespace vpm {
namespace {

/// The largest share of light, in any channel, that comes to the eye from places within a radius of a point of the
/// segment. Optical thickness rises up to the end and is mirrored there: it is least at one end of these places.
class MostSeen {
 public:
  MostSeen(const EyeSegment& segment, const SegmentRegion& region, const PassToEye& pass, float radius)
      : ray_(segment.ray),
        distances_(region.distances()),
        mirrored_(region.mirrored()),
        integrals_(pass.integrals()),
        apart_(radius * glm::length(distances_.slope)) {
    const Rgb& sigma_t = segment.around()->sigma_t;
    thinnest_ = std::min({sigma_t.r, sigma_t.g, sigma_t.b});
  }

  float operator()(float t) const {
    const float middle = distances_.of(t * ray_.direction);
    const float at = std::min(mirrored_(std::max(mirrored_.t0, middle - apart_)), mirrored_(middle + apart_));
    return std::exp(-thinnest_ * (integrals_ ? static_cast<float>(integrals_->at(at).integral) : at - mirrored_.t0));
  }

 private:
  const Ray& ray_;
  PlaneDistances distances_;
  Mirrored mirrored_;
  const DensityIntegralsAlong* integrals_;  // null in a homogeneous medium
  float apart_;                             // m: along the ray, places and the point
  float thinnest_ = 0.0f;                   // 1/m at density 1
};

}  // namespace

void BeamsAroundPoints::build(uint64_t emitted, RenderStatistics& statistics) {
  beams_.build(emitted, statistics,
               [](MediumId, const std::vector<PhotonBeam>& beams, const GatherSettings& of_pass, float, float scale) {
                 return Map{of_pass, PhotonBeamMap(beams, of_pass.radius, scale)};
               });
}

KernelEstimate BeamsAroundPoints::along(const EyeSegment& segment, EyeWork& work) const {
  if (!segment.around()) return {};
  const Map& map = beams_[segment.medium];
  if (map.beams.size() == 0) return {};
  const float radius = map.settings.radius;
  const SegmentRegion region(segment, map.settings, Spread::turned_discs);
  const Interval reach{region.reach().t0 - radius, region.reach().t1 + radius};
  const Interval near = clip(segment.ray, reach, map.beams.bounds(), radius);
  if (near.empty()) return {};
  const Medium& medium = *segment.around();
  const VolumeForm form = beams_.settings().form;
  const PassToEye pass(medium, medium.homogeneous() ? nullptr : &segment.integrals(work), form, region.mirrored());
  const KernelEstimate light =
      segment.throughput * scattering_of_beams(medium, form) * march({segment, region, pass, map}, near, work);
  if (region.whole() || is_black(light.value)) return light;
  const SeenAlong seen(medium.sigma_t, segment.interval, pass.integrals());
  return over_share(light, region.share(radius, seen, work.rng), work.counters.gather);
}

KernelEstimate BeamsAroundPoints::march(const Sight& sight, const Interval& near, EyeWork& work) const {
  const auto& [segment, region, pass, map] = sight;
  const float radius = map.settings.radius;
  const MostSeen most_seen(segment, region, pass, radius);
  const float free_path = 1.0f / std::max(max_channel(segment.around()->majorant()), 1e-30f);  // m, the shortest
  // As many steps as the beams' own part of the ray has: radii far larger than that ask for no more.
  const Interval among = clip(segment.ray, region.reach(), map.beams.bounds(), 0.0f);
  const float stretched = among.empty() ? kInfinity : near.length() / among.length();
  const float step = step_among(std::min(radius, max_optical_step_ * free_path * stretched), near);
  return march_seen(segment.ray, near, step, work.rng, most_seen,
                    [&](const Vec3& point) { return sum(point, sight, work); });
}

/// Of beams whose places nearest to the point lie in the region.
KernelEstimate BeamsAroundPoints::sum(const Vec3& point, const Sight& sight, EyeWork& work) const {
  const EyeSegment& segment = sight.segment;
  const SegmentRegion& region = sight.region;
  const Map& map = sight.map;
  const Ray& ray = segment.ray;
  const Medium& medium = *segment.around();
  const float radius = map.settings.radius, inverse = 1.0f / (radius * radius);
  const PlaneDistances distances = region.distances();
  const Vec3 from_origin = point - ray.origin, towards_eye = -ray.direction;
  GatherCounters& counters = work.counters.gather;
  count(work.counters.volume_queries);
  count(counters.searches);
  KernelPair<Rgbd> light;
  const auto visit = [&](const BeamPlaces& found) {
    Passed passed;
    float along[BeamPlaces::kMost], share[BeamPlaces::kMost];
    for (size_t i = 0; i < found.size; ++i) {
      const Vec3 place = from_origin + Vec3(found.x[i], found.y[i], found.z[i]);
      const float t = glm::dot(place, ray.direction);
      const bool counts = t >= region.reach().t0 && t < region.reach().t1 && region.within().hold(place);
      share[i] = counts ? 1.0f : 0.0f;
      counters.used += counts ? 1 : 0;
      along[i] = distances.of(place);
    }
    sight.pass({along, found.size}, passed);
    multiply_by_left(medium, beams_.settings(), point, found, passed, work.counters.walk);
    light += with_phase_and_kernel<2>(medium.phase, map.settings.kernel, [&](const auto& phase, auto profile) {
      return sum_beams(found, passed, share, phase, towards_eye, profile, inverse);
    });
  };
  count(counters.visited, map.beams.visit_near(point, visit));
  return normed(light, kernel_norm_2d(map.settings.kernel, radius));
}

namespace {

void check_beams_around_points(const RenderSettings& s, const SceneFacts& facts) {
  check_flights(s, facts);
  refuse_in_blocks(s, true, "integrator.volume.type",
                   "eye rays do not know where the beams of all blocks lie, among which they would march",
                   "write \"photon-beams\"");
  refuse_if(s.photons.stored > 0, "integrator.photons.stored",
            "flights do not count towards the photons stored, and in media nothing else is: 'type' of "
            "[integrator.volume] is \"" +
                s.volume.type() + "\"",
            "write 'emitted' instead, or another 'type' in [integrator.volume]");
}

}  // namespace

extern const VolumeEstimatorInfo kBeamsAroundPoints{
    .name = "beams-points",
    .summary = "flights within the radius of points of a march",
    .collisions = false,
    .flights = true,
    .describe = describe_flights,
    .check = check_beams_around_points,
    .make = [](const VolumePlan& plan) -> std::unique_ptr<VolumeEstimator> {
      return std::make_unique<BeamsAroundPoints>(plan.scene, along_rays(plan.settings), plan.pass,
                                                 plan.max_optical_step);
    }};

}  // namespace vpm
