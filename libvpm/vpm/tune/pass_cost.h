// What a pass costs: timed where a render's time is limited, else counted, so that choices by it are the same anywhere.
// Rays that a pass takes together are counted, too, where there is no time to time them together.
#pragma once

#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Is the cost of a pass measured by a clock? It is where the render's time is limited, to which counts say nothing, or
/// where this program counts nothing (VPM_COUNTERS=OFF). Else it is counted, in seconds of one thread of CountedWork.
bool goes_by_clock(const RenderSettings& settings);

/// What a pass costs, s, by a clock or by counts.
struct PassCost {
  double photon = 0.0;              // tracing and sorting, of one emitted photon; 0 where none is
  double eye = 0.0;                 // the eye pass, and learning what guides photons
  double stored_per_photon = 0.0;   // by all maps
  double caustics = 0.0;            // tracing and sorting, of all photons that are aimed for caustics
  double stored_caustics = 0.0;     // of these
  double flights_per_photon = 0.0;  // recorded, of which some become beams or planes
  double gathered = 0.0;            // of `eye`: what goes with the number of photons

  /// s: of what does not go by the number of photons.
  double rest() const { return eye + caustics; }
  /// s: of a pass that emits so many photons.
  double seconds(double photons) const { return rest() + photons * photon; }
  /// By all maps of a pass that emits so many photons.
  double stored(double photons) const { return stored_caustics + photons * stored_per_photon; }
};
/// Renders with the photons of a pass, of either kind a million stored ones at the most, or with as many of its light
/// sub-paths as 200 MB hold, a sample of its rays. Takes about so many seconds at the most, of a clock or counted: then
/// photons are fewer than the settings say, and the cost of the eye pass is scaled by how many it finds of these.
PassCost time_pass(const Scene& scene, const RenderSettings& settings, double seconds = kInfinity);

/// What passes show: a picture what the eye sees, a light map surfaces alone.
enum class PassOf { picture, light_map };
/// The same of the photons alone: the eye pass costs nothing.
PassCost time_photons(const Scene& scene, const RenderSettings& settings, PassOf of, double seconds);

}  // namespace vpm
