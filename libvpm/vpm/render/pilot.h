// The pilot of automatic settings: a few photons and a few rays from the eye tell what a render costs and finds.
#pragma once

#include <optional>

#include "vpm/render/automatic.h"

namespace vpm {

/// What flights cost under each strategy that is exact in the scene's media and keeps weights bounded: a pure function
/// of scene and settings.
std::vector<StrategyCost> strategy_costs(const Scene& scene, const RenderSettings& settings);

/// Of the maps that the render uses; none where the pilot says too little of one.
struct MapDensities {
  std::optional<MapDensity> volume, surface, caustics;
  double stored_per_photon = 0.0;  // by the volume maps or the surface map, whichever holds more
};
/// Where the eye gathers, how near the photons are: a pure function of scene and settings.
MapDensities map_densities(const Scene& scene, const RenderSettings& settings);

/// Times the photons of a pass, a million stored ones at the most, and a sample of its rays.
PassCost time_pass(const Scene& scene, const RenderSettings& settings);

}  // namespace vpm
