// Photons near rays, and the transmittance from their projections onto the ray to the eye.
#include "vpm/estimate/volume/beam_radiance.h"

#include "vpm/base/exp_negative.h"
#include "vpm/photon/stored_power.h"

namespace vpm {
namespace {

/// transmittance() of a finite density integral, as quick as photons along a ray need it: off by 1e-7 of the optical
/// thickness.
inline Rgb beam_transmittance(const Rgb& sigma_t, float integral) {
  const Rgb optical = sigma_t * integral;
  return {exp_negative(-optical.r), exp_negative(-optical.g), exp_negative(-optical.b)};
}

/// beam_transmittance() from places on a ray through a grid; times the relative density there, for the density at the
/// query.
void pass_grid(const DensityIntegralsAlong& integrals, const Medium& medium, VolumeForm form,
               std::span<const float> distances, Passed& passed) {
  float integral[PhotonBatch::kMost], density[PhotonBatch::kMost];
  for (size_t i = 0; i < distances.size(); ++i) {
    const DensityIntegralsAlong::Place place = integrals.at(distances[i]);
    integral[i] = static_cast<float>(place.integral);
    density[i] =
        form == VolumeForm::density_at_query ? relative_density(medium, static_cast<float>(place.density)) : 1.0f;
  }
  for (size_t i = 0; i < distances.size(); ++i) {
    const Rgb kept = beam_transmittance(medium.sigma_t, integral[i]) * density[i];
    passed.r[i] = kept.r;
    passed.g[i] = kept.g;
    passed.b[i] = kept.b;
  }
}

}  // namespace

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
  const bool at_query = maps_.settings().form == VolumeForm::density_at_query;
  KernelEstimate radiance;
  for (size_t m = 0; m < maps_.size(); ++m) {
    const BeamMap& map = maps_[m];
    if (map.photons.size() == 0 || (at_query && &scene_.media[m] != segment.medium())) continue;
    const Interval near = clip(segment.ray, segment.interval, map.photons.bounds(), map.settings.radius);
    if (!near.empty()) radiance += gather(segment, near, m, work);
  }
  return radiance;
}

/// From the photons of one medium that are near an interval of the segment.
KernelEstimate BeamRadiance::gather(const EyeSegment& segment, const Interval& near, size_t number,
                                    EyeWork& work) const {
  const Medium& medium = scene_.media[number];
  const Medium* around = segment.medium();
  const VolumeForm form = maps_.settings().form;
  const Rgb factor = segment.throughput * source_factor(medium);
  GatherCounters& counters = work.counters.gather;
  count(work.counters.volume_queries);
  if (!around || around->homogeneous()) {  // of density 1
    const Rgb sigma_t = around ? around->sigma_t : Rgb(0.0f);
    const auto passed = each_distance([&](float t) { return beam_transmittance(sigma_t, t - segment.interval.t0); });
    return factor * beam_sum(medium.phase, segment.ray, near, passed, maps_[number], counters);
  }
  const DensityIntegralsAlong& integrals = segment.integrals(work);
  const auto passed = [&](std::span<const float> distances, Passed& into) {
    pass_grid(integrals, *around, form, distances, into);
  };
  return factor * beam_sum(medium.phase, segment.ray, near, passed, maps_[number], counters);
}

}  // namespace vpm
