// What a pass costs by what it counts, and not by a clock: the same on any machine.
#pragma once

#include "vpm/estimate/statistics.h"
#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Work, as seconds of one thread of a machine of 2026.
struct CountedWork {
  double seconds = 0.0;
  double of_photons = 0.0;  // of these, what goes with the photons or light sub-paths that are found
};

/// Of rays from the eye, by the settings' integrator. Fitted to the times of 14 scenes, of which most are met to a
/// tenth; of pools of water and glasses of milk, where shares at borders are not counted, half (papers/performance.md).
CountedWork counted_work(const Scene& scene, const RenderSettings& settings, const EyeCounters& eye);

/// Of tracing and sorting the photons or light sub-paths of a pass, s; without those that are aimed for caustics.
double counted_seconds_of_photons(const RenderSettings& settings, const RenderStatistics& pass);
/// Of tracing such ones, and of learning from importons, s: by their numbers alone.
double counted_seconds_of_caustics(double paths);
double counted_seconds_of_guide(uint64_t importons);

}  // namespace vpm
