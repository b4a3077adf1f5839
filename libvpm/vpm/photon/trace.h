// Photon tracing [Jarosz2008, alg. 7.1 to 7.3, corrected]: from the lights, event by event, into recorders.
#pragma once

#include <cstdint>

#include "vpm/base/progress.h"
#include "vpm/medium/distance/strategy.h"
#include "vpm/photon/guide/photon_guide.h"
#include "vpm/photon/ledger.h"
#include "vpm/photon/photon_numbers.h"
#include "vpm/photon/recorder.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// The settings of one pass of photon tracing.
struct TraceSettings {
  uint64_t seed = 1;
  uint64_t pass = 0;
  uint64_t first = 0;        // the number of the first photon
  uint64_t emitted = 0;      // photons to emit at the most; 0: no limit, `stored` decides
  uint64_t stored = 0;       // stop once a recorder has that many (PhotonRecorder::stored()); 0: no limit
  int max_events = 100'000;  // of one photon
  PhotonSequence sequence = PhotonSequence::random;  // of the numbers that photons start with
  const PhotonGuide* guide = nullptr;                // where photons are emitted and scattered; null: as power is
  bool split = false;                                // with a guide: by importance also on their way
};

/// Traces photons in parallel and deposits what becomes of them into the recorders. Photon i depends on the sequence
/// and (seed, pass, i) alone, and the recorders see photons as if these came one after the other. Returns the
/// ledger; the powers that recorders see are those of photons, not yet divided by `emitted_count`.
///
/// Recorders see every collision before the choice between absorption and scattering (photons that weighted
/// strategies made lighter than a tenth of what was emitted first play roulette), and of every hit of a surface before
/// it scatters. A photon is direct until its first scattering, reflection or refraction; crossing a boundary is none.
Ledger trace_photons(const Scene& scene, const DistanceStrategy& strategy, const TraceSettings& settings,
                     const Recorders& recorders, Progress& progress);

}  // namespace vpm
