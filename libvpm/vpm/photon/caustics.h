// Photons that are aimed at mirrors and glass, for a separate caustic map.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/photon/guide/photon_guide.h"
#include "vpm/photon/photon.h"

namespace vpm {

/// The settings of one pass of caustic photons.
struct CausticSettings {
  uint64_t seed = 1;
  uint64_t pass = 0;
  uint64_t emitted = 0;  // photons to emit, >= 1
  int max_events = 100'000;
  const ImportanceMap* importance = nullptr;  // how much a caustic matters to the picture; null: all equally
};

/// The paths that so many photons take, with those of the scouts that are traced first.
double caustic_paths(uint64_t emitted);

/// Traces the photons that go from a light via one or more mirrors or smooth glass surfaces, and via nothing else, to
/// a non-specular surface (L S+ D in the notation of [Heckbert1990]). Scouts are traced first, and emission is guided
/// by what they found. Photons end where they are stored. Powers are not yet divided by `settings.emitted`. The result
/// is in the order of photons, whatever the number of threads.
std::vector<Photon> trace_caustics(const Scene& scene, const DistanceStrategy& strategy,
                                   const CausticSettings& settings);

}  // namespace vpm
