// Merging of counts.
#include "vpm/estimate/statistics.h"

#include <algorithm>

namespace vpm {

void EyeCounters::merge(const EyeCounters& other) {
  rays += other.rays;
  steps += other.steps;
  volume_queries += other.volume_queries;
  surface_queries += other.surface_queries;
  shadow_rays += other.shadow_rays;
  gather_rays += other.gather_rays;
  irradiance_lookups += other.irradiance_lookups;
  irradiance_misses += other.irradiance_misses;
  cut_paths += other.cut_paths;
  non_finite += other.non_finite;
  weights.merge(other.weights);
  gather.merge(other.gather);
  walk.merge(other.walk);
}

void RenderStatistics::merge(const RenderStatistics& pass) {
  passes += pass.passes;
  guide_seconds += pass.guide_seconds;
  trace_seconds += pass.trace_seconds;
  build_seconds += pass.build_seconds;
  eye_seconds += pass.eye_seconds;
  ledger.merge(pass.ledger);
  volume_photons += pass.volume_photons;
  surface_photons += pass.surface_photons;
  caustic_photons += pass.caustic_photons;
  guiding_photons += pass.guiding_photons;
  irradiance_points += pass.irradiance_points;
  merged_photons += pass.merged_photons;
  photon_map_bytes = std::max(photon_map_bytes, pass.photon_map_bytes);
  guide_bytes = std::max(guide_bytes, pass.guide_bytes);
  last_volume_radius = pass.last_volume_radius;
  last_surface_radius = pass.last_surface_radius;
  eye.merge(pass.eye);
}

}  // namespace vpm
