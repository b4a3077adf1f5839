// What estimators of volumes and of surfaces have in common: they are made for one pass, say which photons they want,
// sort them, and then answer rays without changing any more.
#pragma once

#include <string_view>
#include <vector>

#include "vpm/estimate/statistics.h"
#include "vpm/photon/photon.h"
#include "vpm/photon/trace.h"

namespace vpm {

struct PhotonBeam;

/// A photon map that an estimator gathers from in a pass.
struct MapInfo {
  std::string_view section;                                 // of the scene file, that holds its settings
  int dimension = 3;                                        // of its kernel
  bool shows_bias = true;                                   // its estimates tell the correction of their kernels
  const std::vector<std::vector<Photon>>* media = nullptr;  // its photons before build(), by medium ...
  const std::vector<Photon>* surfaces = nullptr;            // ... or on surfaces; W, of `emitted` photons
  uint64_t emitted = 0;                                     // for this map alone; 0: as many as in the ledger
  /// What is gathered besides, before build(), by medium.
  const std::vector<std::vector<PhotonBeam>>* flights = nullptr;
};

/// The photon tracing of a pass, once it is over.
struct TracedPass {
  const DistanceStrategy& strategy;
  const TraceSettings& settings;
  uint64_t emitted;  // photons
};

class Estimator {
 public:
  virtual ~Estimator() = default;
  /// The maps that it gathers from, if any.
  virtual std::vector<MapInfo> maps() const { return {}; }
  /// What photon tracing is to deposit into before build().
  virtual Recorders recorders() { return {}; }
  /// Traces photons of its own, after the others and before build(), where it wants any, and counts that.
  virtual void trace_more(const TracedPass&, RenderStatistics&) {}
  /// Sorts what was deposited, of so many emitted photons, and counts that; once.
  virtual void build(uint64_t /*emitted*/, RenderStatistics&) {}
};

}  // namespace vpm
