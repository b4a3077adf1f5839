// Even steps among photons.
#include "vpm/estimate/volume/points_at_photon.h"

#include "vpm/estimate/volume_estimate.h"
#include "vpm/photon/stored_power.h"

namespace vpm {

void PointsAtPhoton::build(uint64_t emitted, RenderStatistics& statistics) {
  maps_.build(emitted, statistics,
              [&](std::vector<Photon>& photons, const GatherSettings& gather, float, uint64_t of, RenderStatistics& s) {
                return make_map(photons, gather, of, maps_.settings().pass, s);
              });
}

KernelEstimate PointsAtPhoton::along(const EyeSegment& segment, EyeWork& work) const {
  KernelEstimate radiance;
  for (size_t m = 0; m < maps_.size(); ++m) {
    const PhotonMap& map = maps_[m];
    const Interval near = clip(segment.ray, segment.interval, map.bounds(), map.settings.radius);
    if (map.size() == 0 || near.empty()) continue;
    const Medium& medium = scene_.media[m];
    const Rgb factor = segment.throughput * source_factor(medium);
    const auto add = [&](const Vec3& point, const Rgb& weight) {
      count(work.counters.volume_queries);
      radiance +=
          factor * weight * volume_sum(medium.phase, point, -segment.ray.direction, CountedMap{map, work.gather()});
    };
    const SeenThrough seen{segment.ray, segment.integrals(work),
                           segment.medium() ? segment.medium()->sigma_t : Rgb(0.0f)};
    march_evenly(seen, near, step_among(map, near), work.rng, add);
  }
  return radiance;
}

}  // namespace vpm
