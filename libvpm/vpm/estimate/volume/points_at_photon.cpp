// Even steps among photons.
#include "vpm/estimate/volume/points_at_photon.h"

#include "vpm/estimate/volume/points_of_segment.h"
#include "vpm/photon/stored_power.h"

namespace vpm {

void PointsAtPhoton::build(uint64_t emitted, RenderStatistics& statistics) {
  maps_.build(emitted, statistics,
              [&](std::vector<Photon>& photons, const GatherSettings& gather, float, uint64_t of, RenderStatistics& s) {
                return make_map(photons, gather, of, maps_.settings().pass, s);
              });
}

KernelEstimate PointsAtPhoton::along(const EyeSegment& segment, EyeWork& work) const {
  if (!segment.medium()) return {};
  const Box& around = maps_.around(segment.number);
  if (around.empty()) return {};
  const PointsOfSegment points(segment, maps_[segment.number], around, maps_.settings().form);
  const Rgb factor = segment.throughput * source_factor(*segment.medium());
  return points.over_share(factor * points.march_evenly(work), work);
}

}  // namespace vpm
