// Photons aimed at mirrors and glass: a caustic map's own.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "vpm/photon/photon.h"
#include "vpm/photon/photon_guide.h"

namespace vpm {

/// What one pass of caustic photons is told.
struct CausticSettings {
  uint64_t seed = 1;
  uint64_t pass = 0;
  uint64_t emitted = 0;  // photons, >= 1
  int max_events = 100'000;
  const ImportanceMap* importance = nullptr;  // what caustics matter to the picture; null: all alike
  const std::atomic<bool>* stop = nullptr;    // once true, tracing ends as soon as it can
};

/// The photons that go from a light by mirrors and glass alone, one at least, to a rough surface (L S+ D in the
/// notation of [Heckbert1990]), as many of which are emitted as scouts have learned to aim there. They end where they
/// are stored. Powers are those of the photons, not yet divided by `settings.emitted`. In the order of photons,
/// whatever the number of threads.
std::vector<Photon> trace_caustics(const Scene& scene, const DistanceStrategy& strategy,
                                   const CausticSettings& settings);

}  // namespace vpm
