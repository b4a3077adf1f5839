// Small passes of photons. Maps of few photons, made many times, have the same mean as one large map, and their errors
// are those of independent samples.
#pragma once

#include "vpm/photon/trace.h"

namespace vpm {

/// Photons of one pass, seeded by `rng`.
inline TracedPhotons small_pass(const Scene& scene, const DistanceStrategy& strategy, Rng& rng, uint64_t emitted = 100,
                                VolumeForm form = VolumeForm::density_at_query) {
  TraceSettings settings;
  settings.seed = rng.bits();
  settings.emitted = emitted;
  settings.volume_form = form;
  Progress progress("", 0, false);
  return trace_photons(scene, strategy, settings, progress);
}

}  // namespace vpm
