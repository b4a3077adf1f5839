// Small passes of photons. Maps of few photons, made many times, have the same mean as one large map, and their errors
// are those of independent samples.
#pragma once

#include "vpm/photon/records.h"

namespace vpm {

/// Photons of one pass, seeded by `rng`.
inline PhotonLists small_pass(const Scene& scene, const DistanceStrategy& strategy, Rng& rng, uint64_t emitted = 100) {
  ListSettings settings;
  settings.seed = rng.bits();
  settings.emitted = emitted;
  return list_photons(scene, strategy, settings);
}

}  // namespace vpm
