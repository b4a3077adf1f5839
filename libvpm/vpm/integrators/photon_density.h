// How dense photons lie where the eye gathers them: a few photons and a few paths from the eye say.
#pragma once

#include <optional>

#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// How dense photons lie where they are gathered, or how near to there flights pass, where these are gathered.
struct MapDensity {
  double reach = 0.0;      // m: at a typical place as many photons or flights as `within` lie within it ...
  double within = 0.0;     // > 0
  double emitted = 0.0;    // ... of this many photons emitted
  int dimension = 3;       // of what holds them: a ball; a disc on a surface, or across flights
  double footprint = 0.0;  // m: of a pixel at a typical place
  // m: of media, at typical places in them, the least of them; infinite on surfaces
  double thickness = kInfinity;
  double free_path = kInfinity;
  const char* records = "photons";
};
/// Of the maps that the render uses; none where the pilot says too little of one.
struct MapDensities {
  std::optional<MapDensity> volume, surface, caustics;
  double stored_per_photon = 0.0;  // by the volume maps or the surface map, whichever holds more
};
/// Where the eye gathers, or, where it does not come there, at the photons: how near others are. A pure function of
/// scene and settings; `photons` are emitted at the most.
MapDensities map_densities(const Scene& scene, const RenderSettings& settings, uint64_t photons);

/// The photons that a pass emits: the settings', or as many as fill the maps, of which so many are stored each.
double photons_of_pass(const RenderSettings& settings, double stored_per_photon);

/// The settings of a pilot that emits so many photons, with a seed of their own: what is chosen does not depend on the
/// photons that the render will gather.
RenderSettings pilot_settings(RenderSettings settings, uint64_t photons);

}  // namespace vpm
