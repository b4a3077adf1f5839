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
  uint64_t shared_gathers = 0;  // taken from the ray of a neighbouring pixel: SharedGather
  uint64_t used_in_media = 0, by_count_in_media = 0, short_in_media = 0;  // of GatherCounters: those of media
  uint64_t shadow_rays = 0;
  uint64_t gather_rays = 0;         // of final gathering
  uint64_t irradiance_lookups = 0;  // ends of these that took the irradiance of a point computed beforehand
  uint64_t irradiance_misses = 0;   // those near no such point, which asked the map
  uint64_t cut_paths = 0;           // that reached the limit of events
  uint64_t non_finite = 0;          // samples that were dropped because they were not finite
  WeightMoments weights;            // of the path tracer's paths: PathWeight, a mean over channels
  GatherCounters gather;
  WalkCounters walk;

  static constexpr auto counters() {
    using E = EyeCounters;
    return std::tuple{Counter{"camera_rays", &E::rays},
                      Counter{"marching_steps", &E::steps},
                      Counter{"volume_queries", &E::volume_queries},
                      Counter{"surface_queries", &E::surface_queries},
                      Counter{"gathers_shared", &E::shared_gathers},
                      Counter{"photons_used_in_media", &E::used_in_media},
                      Counter{"sums_by_count_in_media", &E::by_count_in_media},
                      Counter{"sums_by_count_in_media_of_fewer_photons", &E::short_in_media},
                      Counter{"shadow_rays", &E::shadow_rays},
                      Counter{"gather_rays", &E::gather_rays},
                      Counter{"irradiance_lookups", &E::irradiance_lookups},
                      Counter{"irradiance_misses", &E::irradiance_misses},
                      Counter{"paths_cut_at_max_events", &E::cut_paths},
                      Counter{"dropped_non_finite", &E::non_finite},
                      Counter{"weights", &E::weights},
                      Counter{"", &E::gather},
                      Counter{"", &E::walk}};
  }
  void merge(const EyeCounters& other);
};
static_assert(lists_every_member<EyeCounters>());

/// Sums over passes; members that are no sums say so.
struct RenderStatistics {
  int64_t passes = 0;
  double guide_seconds = 0.0, trace_seconds = 0.0, build_seconds = 0.0, eye_seconds = 0.0;  // wall clock
  double caustic_seconds = 0.0;  // likewise: of photons that are aimed at mirrors and glass, not in trace_seconds
  Ledger ledger;
  uint64_t volume_photons = 0, surface_photons = 0, caustic_photons = 0;  // stored
  uint64_t aimed_photons = 0;                                             // of the caustic ones: those that are aimed
  uint64_t guiding_photons = 0, irradiance_points = 0;                    // stored besides, for final gathering
  uint64_t flights = 0, beams = 0, planes = 0;  // recorded flights; those of them kept as such
  uint64_t merged_photons = 0;                  // of these: those whose power others took over, see control_density()
  uint64_t photon_map_bytes = 0, guide_bytes = 0;               // of the largest pass
  float last_volume_radius = 0.0f, last_surface_radius = 0.0f;  // m; of the last pass, the largest over media, pixels
  EyeCounters eye;

  static constexpr auto counters() {
    using S = RenderStatistics;
    return std::tuple{Counter{"passes", &S::passes},
                      Counter{"times.importance", &S::guide_seconds},
                      Counter{"times.photon_tracing", &S::trace_seconds},
                      Counter{"times.caustic_tracing", &S::caustic_seconds},
                      Counter{"times.map_building", &S::build_seconds},
                      Counter{"times.eye_pass", &S::eye_seconds},
                      Counter{"", &S::ledger},
                      Counter{"photons.stored_volume", &S::volume_photons},
                      Counter{"photons.stored_surface", &S::surface_photons},
                      Counter{"photons.stored_caustic", &S::caustic_photons},
                      Counter{"photons.stored_caustic_aimed", &S::aimed_photons},
                      Counter{"photons.stored_to_guide_gathering", &S::guiding_photons},
                      Counter{"photons.irradiance_points", &S::irradiance_points},
                      Counter{"photons.flights", &S::flights},
                      Counter{"photons.stored_beams", &S::beams},
                      Counter{"photons.stored_planes", &S::planes},
                      Counter{"photons.merged", &S::merged_photons},
                      Counter{"memory.largest_photon_maps", &S::photon_map_bytes, CountRule::largest},
                      Counter{"memory.importance", &S::guide_bytes, CountRule::largest},
                      Counter{"eye.last_volume_radius_m", &S::last_volume_radius, CountRule::last},
                      Counter{"eye.last_surface_radius_m", &S::last_surface_radius, CountRule::last},
                      Counter{"eye", &S::eye}};
  }
  /// Adds a further pass.
  void merge(const RenderStatistics& pass);
};
static_assert(lists_every_member<RenderStatistics>());

}  // namespace vpm
