// Sums over photons around points of the ray's own medium.
#include "vpm/estimate/volume/points_at_query.h"

#include "vpm/estimate/volume_estimate.h"
#include "vpm/estimate/volume_region.h"
#include "vpm/photon/stored_power.h"

namespace vpm {

void PointsAtQuery::build(uint64_t emitted, RenderStatistics& statistics) {
  maps_.build(emitted, statistics,
              [&](std::vector<Photon>& photons, const GatherSettings& gather, float, uint64_t of, RenderStatistics& s) {
                return make_map(photons, gather, of, maps_.settings().pass, s);
              });
}

MarchedSource::Reach PointsAtQuery::reach(const EyeSegment& segment) const {
  const PhotonMap& map = maps_[segment.number];
  if (map.size() == 0) return {{segment.interval.t1, segment.interval.t1}};
  const Interval near = clip(segment.ray, segment.interval, map.bounds(), map.settings.radius);
  return {near, step_among(map, near)};
}

KernelEstimate PointsAtQuery::at(const EyeSegment& segment, const Vec3& point, EyeWork& work) const {
  const Medium& medium = *segment.medium();
  const PhotonMap& map = maps_[segment.number];
  const Vec3 towards_eye = -segment.ray.direction;
  const Rgb factor = source_factor(medium);
  count(work.counters.volume_queries);
  if (map.settings.boundary == BoundaryRule::none)
    return factor * volume_sum(medium.phase, point, towards_eye, CountedMap{map, work.gather()});
  const VolumeRegion region(scene_, segment.number, point, map.settings.kernel);
  return factor * volume_sum(medium.phase, point, towards_eye, BoundedMap{map, region, work.gather()});
}

}  // namespace vpm
