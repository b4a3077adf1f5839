// What a render counts and measures, for its report.
#pragma once

#include "vpm/estimate/gather.h"
#include "vpm/photon/ledger.h"

namespace vpm {

/// Counts of the eye pass.
struct EyeCounters {
  uint64_t rays = 0;
  uint64_t steps = 0;  // marching steps in media
  uint64_t volume_queries = 0;
  uint64_t surface_queries = 0;
  uint64_t shadow_rays = 0;
  uint64_t gather_rays = 0;         // of final gathering
  uint64_t irradiance_lookups = 0;  // ends of these that took the irradiance of a point computed beforehand
  uint64_t irradiance_misses = 0;   // those near no such point, which asked the map
  uint64_t cut_paths = 0;           // that reached the limit of events
  uint64_t non_finite = 0;          // samples that were dropped because they were not finite
  WeightMoments weights;            // of the path tracer's paths: PathWeight, a mean over channels
  GatherCounters gather;
  WalkCounters walk;

  void merge(const EyeCounters& other);
};

/// Sums over passes, but for what says otherwise.
struct RenderStatistics {
  int passes = 0;
  double guide_seconds = 0.0, trace_seconds = 0.0, build_seconds = 0.0, eye_seconds = 0.0;  // wall clock
  Ledger ledger;
  uint64_t volume_photons = 0, surface_photons = 0, caustic_photons = 0;  // stored
  uint64_t guiding_photons = 0, irradiance_points = 0;                    // stored besides, for final gathering
  uint64_t merged_photons = 0;  // of these: those whose power others took over, see control_density()
  uint64_t photon_map_bytes = 0, guide_bytes = 0;               // of the largest pass
  float last_volume_radius = 0.0f, last_surface_radius = 0.0f;  // m; of the last pass, the largest over media, pixels
  EyeCounters eye;

  void merge(const RenderStatistics& pass);
};

}  // namespace vpm
