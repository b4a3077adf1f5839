// A ball about each point: as it is, cut by the planes of the segment's region, or in a region of its own.
#include "vpm/integrators/photon_map/volume/points_of_segment.h"

#include <algorithm>

#include "vpm/estimate/beam_estimate.h"
#include "vpm/estimate/volume_estimate.h"
#include "vpm/estimate/volume_region.h"

namespace vpm {

template KernelEstimate volume_sum(const Phase&, const Vec3&, const Vec3&, const PhotonMap&);
template KernelEstimate volume_sum(const Phase&, const Vec3&, const Vec3&, const CountedMap&);
template KernelEstimate volume_sum(const Phase&, const Vec3&, const Vec3&, const BoundedMap<VolumeRegion>&);
template Rgb fluence(const Rgb&, const Vec3&, const PhotonMap&);
template Rgb fluence(const Rgb&, const Vec3&, const BoundedMap<VolumeRegion>&);

namespace {

/// What the region of a segment goes by.
GatherSettings of_segment(const GatherSettings& gather) {
  GatherSettings settings = gather;
  if (gather.corrects_each_ball()) settings.boundary = BoundaryRule::none;
  return settings;
}

/// Photons have their own transmittances where it costs no look-ups in a grid.
Spread spread_of(const EyeSegment& segment, const GatherSettings& gather) {
  const bool at_ends = of_segment(gather).boundary == BoundaryRule::ends;
  return at_ends && segment.around()->homogeneous() ? Spread::balls_as_discs : Spread::balls;
}

}  // namespace

void build_around_points(VolumeMaps<PhotonMap>& maps, uint64_t emitted, RenderStatistics& statistics) {
  maps.build(emitted, statistics,
             [&](std::vector<Photon>& photons, const GatherSettings& gather, float, uint64_t of, RenderStatistics& s) {
               return make_map(photons, gather, of, maps.pass(), s);
             });
}

PointsOfSegment::PointsOfSegment(const EyeSegment& segment, const PhotonMap& map, const Box& around, VolumeForm form)
    : segment_(segment),
      map_(map),
      form_(form),
      spread_(spread_of(segment, map.settings)),
      region_(segment, of_segment(map.settings), spread_),
      reach_(region_.reach()) {
  const float radius = map.settings.radius;
  if (seen_one_by_one()) reach_ = {reach_.t0 - radius, reach_.t1 + radius};
  reach_ = clip(segment.ray, reach_, around, radius);
}

KernelEstimate PointsOfSegment::sum(const Vec3& point, EyeWork& work) const {
  count(work.counters.volume_queries);
  const Phase& phase = segment_.around()->phase;
  const Vec3 towards_eye = -segment_.ray.direction;
  if (map_.settings.corrects_each_ball()) {
    const VolumeRegion region(segment_.scene, segment_.medium, point, map_.settings.kernel, form_);
    return volume_sum(phase, point, towards_eye, BoundedMap{map_, region, work.gather()});
  }
  const CountedMap map{map_, work.gather()};
  const Vec3 from_origin = point - segment_.ray.origin;
  if (region_.within().hold_ball(from_origin, map_.settings.radius)) return volume_sum(phase, point, towards_eye, map);
  const auto within = [&](const PackedDirection&, const Vec3& offset) {
    return region_.within().hold(from_origin + offset);
  };
  return volume_sum_of(within, phase, point, towards_eye, map);
}

/// The same sum, of photons that project into the region's reach; each times its own transmittance.
KernelEstimate PointsOfSegment::sum_of_seen(const Vec3& point, EyeWork& work) const {
  const Medium& medium = *segment_.around();
  const RadiusMap& map = std::get<RadiusMap>(map_.index);
  const Ray& ray = segment_.ray;
  const float radius = map_.settings.radius, inverse = 1.0f / (radius * radius);
  const PlaneDistances distances = region_.distances();
  const Mirrored mirrored = region_.mirrored();
  const Rgb sigma_t = medium.sigma_t;
  const Vec3 from_origin = point - ray.origin;
  const auto accept = [&](const PackedDirection&, const Vec3& offset) {
    const float t = glm::dot(from_origin + offset, ray.direction);
    return t >= region_.reach().t0 && t < region_.reach().t1 && region_.within().hold(from_origin + offset);
  };
  GatherCounters& counters = work.counters.gather;
  count(work.counters.volume_queries);
  count(counters.searches);
  const KernelKind kernel = map_.settings.kernel;
  KernelPair<Rgbd> sum;
  const auto visit = [&](NearPhotons& near) {
    near.keep(map.photons(), point, accept);
    counters.used += near.size();
    if (near.size() == 0) return;
    const PhotonBatch batch(map.photons(), near.photons(), near.distances2(), near.size());
    float along[PhotonBatch::kMost] = {};  // m, from the segment's start
    for (size_t i = 0; i < near.size(); ++i)
      along[i] = distances.of(map.photons().position(near.photons()[i]) - ray.origin);
    sum += with_phase_and_kernel<3>(medium.phase, kernel, [&](const auto& phase, auto profile) {
      const auto weight = [&](size_t i) {
        const KernelPair<float> spread = profile(batch.distance2(i) * inverse);
        const Rgb kept = beam_transmittance(sigma_t, mirrored(along[i]) - mirrored.t0);
        return KernelPair<Rgb>(kept * spread.value, kept * spread.correction);
      };
      return sum_photons(batch, weight, [&](const Vec3& travel, const Rgb& power) {
        return power * phase.value(travel, -ray.direction);
      });
    });
  };
  count(counters.visited, map.visit_near(point, radius, visit));
  return normed(sum, kernel_norm_3d(kernel, radius));
}

KernelEstimate PointsOfSegment::march_seen(EyeWork& work) const {
  const Rgb& sigma_t = segment_.around()->sigma_t;
  const float thinnest = std::min({sigma_t.r, sigma_t.g, sigma_t.b});
  const PlaneDistances distances = region_.distances();
  const float deeper = map_.settings.radius * glm::length(distances.slope);  // a point is, than photons around it
  const auto most_seen = [&](float t) {
    const Vec3 from_origin = t * segment_.ray.direction;
    return std::exp(-thinnest * (distances.of(from_origin) - segment_.interval.t0 - deeper));
  };
  return vpm::march_seen(segment_.ray, reach_, step_among(map_.settings.radius, reach_), work.rng, most_seen,
                         [&](const Vec3& point) { return sum_of_seen(point, work); });
}

KernelEstimate PointsOfSegment::march_evenly(EyeWork& work) const {
  if (reach_.empty()) return {};
  if (seen_one_by_one()) return march_seen(work);
  KernelEstimate all;
  const auto add = [&](const Vec3& point, const Rgb& weight) { all += weight * sum(point, work); };
  const SeenThrough seen{segment_.ray, segment_.integrals(work), segment_.around()->sigma_t};
  vpm::march_evenly(seen, reach_, step_among(map_.settings.radius, reach_), work.rng, add,
                    [mirrored = mirrored()](double t) { return mirrored(static_cast<float>(t)); });
  return all;
}

KernelEstimate PointsOfSegment::over_share(const KernelEstimate& light, EyeWork& work) const {
  if (region_.whole() || is_black(light.value)) return light;
  const Medium& medium = *segment_.around();
  const SeenAlong seen(medium.sigma_t, segment_.interval, medium.homogeneous() ? nullptr : &segment_.integrals(work));
  return vpm::over_share(light, region_.share(map_.settings.radius, seen, work.rng), work.counters.gather);
}

}  // namespace vpm
