// Photons near rays, and the transmittance from their projections onto the ray to the eye.
#include "vpm/estimate/volume/beam_radiance.h"

#include "vpm/estimate/volume/pass_to_eye.h"
#include "vpm/photon/stored_power.h"

namespace vpm {
void BeamRadiance::build(uint64_t emitted, RenderStatistics& statistics) {
  const auto make = [&](std::vector<Photon>& photons, const GatherSettings& gather, float shrunk, uint64_t of,
                        RenderStatistics& s) {
    merge_photons(photons, gather, maps_.settings().pass, s);
    const auto scale = static_cast<float>(1.0 / static_cast<double>(of));
    BeamMap map{gather, SegmentMap(std::exchange(photons, {}), {gather.radius, gather.beam_count, shrunk}, scale)};
    s.photon_map_bytes += map.photons.memory_bytes();
    return map;
  };
  maps_.build(emitted, statistics, make);
}

KernelEstimate BeamRadiance::along(const EyeSegment& segment, EyeWork& work) const {
  if (!segment.medium()) return {};
  const BeamMap& map = maps_[segment.number];
  if (map.photons.size() == 0) return {};
  const SegmentRegion region(segment, map.settings, Spread::discs);
  const Interval near = clip(segment.ray, region.reach(), map.photons.bounds(), map.settings.radius);
  return near.empty() ? KernelEstimate() : gather(segment, region, near, work);
}

/// From the photons near an interval of the ray.
KernelEstimate BeamRadiance::gather(const EyeSegment& segment, const SegmentRegion& region, const Interval& near,
                                    EyeWork& work) const {
  const Medium& medium = *segment.medium();
  const VolumeForm form = maps_.settings().form;
  const Mirrored mirrored = region.mirrored();
  const BesideRay there(segment.ray, near, region.within(), region.distances());
  const DensityIntegralsAlong* integrals = medium.homogeneous() ? nullptr : &segment.integrals(work);
  count(work.counters.volume_queries);
  const auto passed = [&](std::span<const float> distances, Passed& into) {
    pass_to_eye(medium, integrals, form, mirrored, distances, into);
  };
  const BeamSum found = beam_sum(medium.phase, there, passed, maps_[segment.number], work.counters.gather);
  const KernelEstimate light = segment.throughput * source_factor(medium) * found.sum;
  if (region.whole() || found.radius == 0.0f) return light;
  const SeenAlong seen(medium.sigma_t, segment.interval, integrals);
  return over_share(light, region.share(found.radius, seen, work.rng), work.counters.gather);
}

}  // namespace vpm
