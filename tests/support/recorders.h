// Photons traced into recorders of a test's own.
#pragma once

#include "vpm/photon/trace.h"

namespace vpm {

/// By the default strategy, without showing progress.
inline Ledger trace_into(const Scene& scene, const TraceSettings& settings, const Recorders& recorders) {
  Progress silent("photons", 0, false);
  return trace_photons(scene, *make_distance_strategy({}), settings, recorders, silent);
}

}  // namespace vpm
