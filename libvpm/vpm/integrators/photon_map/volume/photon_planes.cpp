// L = sum over planes of Phi W(s) sigma_s(x1) T(x1, x2) p sigma_s(x2) T(t) / determinant [Bitterli2017].
#include "vpm/integrators/photon_map/volume/photon_planes.h"
#include "vpm/integrators/photon_map/volume/estimators.h"

#include <utility>
#include <variant>

#include "vpm/integrators/photon_map/check.h"
#include "vpm/integrators/photon_map/volume/pass_to_eye.h"
#include "vpm/integrators/words.h"
#include "vpm/path/direct_light.h"
#include "vpm/photon/photon_beam.h"

namespace vpm {

PhotonPlanes::PhotonPlanes(const Scene& scene, std::shared_ptr<const TransmittanceEstimator> transmittance,
                           const VolumeSettings& settings, const MediaPass& pass)
    : scene_(scene),
      transmittance_(std::move(transmittance)),
      settings_(settings),
      pass_(pass),
      beams_(scene, settings, pass, settings.share),
      flights_(scene, any_photon, {}) {}

Recorders PhotonPlanes::recorders() {
  Recorders all = beams_.recorders();
  all.push_back(&flights_);
  return all;
}

void PhotonPlanes::build(uint64_t emitted, RenderStatistics& statistics) {
  Rng rng(pass_.seed, rng_stream(RngUse::plane, static_cast<uint64_t>(pass_.maps.number)), 0);
  const float kept = thin(flights_.beams, settings_.planes, rng);
  const auto scale = static_cast<float>(1.0 / static_cast<double>(emitted));
  planes_ = PhotonPlaneList(planes_of(std::exchange(flights_.beams, {}), scene_, scale, rng));
  statistics.planes += planes_.size();
  statistics.photon_map_bytes += planes_.memory_bytes();
  beams_.build_beside(kept, emitted, statistics);
}

KernelEstimate PhotonPlanes::along(const EyeSegment& segment, EyeWork& work) const {
  if (!segment.around()) return {};
  KernelEstimate light = beams_.along(segment, work);
  if (segment.around()->scatters()) light += planes_along(segment, work);
  return light;
}

void PhotonPlanes::along_bundle(const Vec3& apex, SegmentBundle bundle) const {
  beams_.along_bundle(apex, bundle);
  for (BundledSegment& of : bundle)
    if (of.segment->around()->scatters()) of.light += planes_along(*of.segment, *of.work);
}

Rgb PhotonPlanes::planes_along(const EyeSegment& segment, EyeWork& work) const {
  const Medium& medium = *segment.around();
  const Interval interval = medium.clip(segment.ray, segment.interval);
  if (interval.empty()) return Rgb(0.0f);
  const DensityIntegralsAlong& integrals = segment.integrals(work);
  const Vec3 towards_eye = -segment.ray.direction;
  count(work.counters.volume_queries);
  const auto sum = [&](const auto& phase) {
    Rgbd sum_of_planes(0.0);
    planes_.visit_crossings(segment.ray, interval, [&](const PlaneCrossing& crossing) {
      ++work.counters.gather.used;
      const DensityIntegralsAlong::Place place = integrals.at(crossing.t);
      if (!(place.density > 0.0)) return;
      const Rgb seen = beam_transmittance(medium.sigma_t, static_cast<float>(place.integral)) *
                       (phase.value(crossing.plane.scattered, towards_eye) * static_cast<float>(place.density));
      sum_of_planes += Rgbd(seen * arriving(crossing, segment, work));
    });
    return sum_of_planes;
  };
  return segment.throughput * medium.sigma_s * Rgb(std::visit(sum, medium.phase));
}

Rgb PhotonPlanes::arriving(const PlaneCrossing& crossing, const EyeSegment& segment, EyeWork& work) const {
  const PhotonPlane& plane = crossing.plane;
  const Medium& around = scene_.media[plane.medium];
  const Ray flight{plane.origin, plane.direction};
  const Vec3 collision = flight.at(crossing.along_flight);
  const float density = around.density(collision);
  count(work.counters.walk.lookups);
  if (!(density > 0.0f)) return Rgb(0.0f);
  count(work.counters.shadow_rays);
  const ShadowRays rays{scene_, *transmittance_, work.rng, work.counters.walk};
  const Rgb passed = visibility_of_place(rays, {collision, plane.scattered}, crossing.beyond, plane.medium);
  if (is_black(passed)) return Rgb(0.0f);
  float share = 1.0f / crossing.determinant;
  if (settings_.share == PlaneUse::combined) {
    const float sine = glm::length(glm::cross(plane.scattered, segment.ray.direction));
    const float sigma_s = mean_channel(around.sigma_s) * density;
    share = beams_.balance(segment.medium).of_planes_over_determinant(sine, sigma_s, crossing.determinant);
  }
  const Rgb collided = plane.power * around.sigma_s *
                       weight_along(around, flight, plane.power, crossing.along_flight, work.counters.walk);
  return collided * passed * (density * share);
}

namespace {

void describe_planes(VolumeSettings& settings, Description& description) {
  describe_flights(settings, description);
  const Members<VolumeSettings> of(settings, description);
  of.add(
      "planes", &VolumeSettings::planes, Integers{1, 1'000'000},
      "at most so many flights of a pass become planes, likewise. Eye rays send a shadow ray for each plane that they "
      "cross");
  of.add("share", &VolumeSettings::share,
         "light that planes can find is `\"combined\"` from them and beams; or comes from planes `\"alone\"`, without "
         "any bias but of infinite variance, for study");
}

void check_photon_planes(const RenderSettings& s, const SceneFacts& facts) {
  check_photon_beams(s, facts);
  refuse_in_blocks(s, true, "integrator.volume.type", "planes cannot be drawn from the flights of all blocks",
                   "write \"photon-beams\"");
}

}  // namespace

extern const VolumeEstimatorInfo kPhotonPlanes{
    .name = "photon-planes",
    .summary = "these, and planes without a radius for light that media scatter twice in turn",
    .along_rays = true,
    .flights = true,
    .planes = true,
    .describe = describe_planes,
    .check = check_photon_planes,
    .make = [](const VolumePlan& plan) -> std::unique_ptr<VolumeEstimator> {
      return std::make_unique<PhotonPlanes>(plan.scene, plan.transmittance, along_rays(plan.settings), plan.pass);
    }};

}  // namespace vpm
