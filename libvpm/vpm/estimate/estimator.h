// What estimators of volumes and of surfaces have in common: they are made for one pass, say which photons they want,
// sort them, and then answer rays without changing any more.
#pragma once

#include <string_view>
#include <vector>

#include "vpm/estimate/statistics.h"
#include "vpm/photon/photon.h"
#include "vpm/photon/trace.h"

namespace vpm {

/// A photon map that an estimator gathers from in a pass.
struct MapInfo {
  std::string_view section;                                 // of the scene file, that holds its settings
  int dimension = 3;                                        // of its kernel
  bool shrinks = false;                                     // its radii go by the number of the pass
  const std::vector<std::vector<Photon>>* media = nullptr;  // its photons before build(), by medium ...
  const std::vector<Photon>* surfaces = nullptr;            // ... or on surfaces; W, of `emitted` photons
  uint64_t emitted = 0;                                     // for this map alone; 0: as many as in the ledger
  int order = 2;                                            // of its kernel, kernel_order()
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
  /// Traces photons of its own, after the others and before build(), where it wants any.
  virtual void trace_more(const TracedPass&) {}
  /// Sorts what was deposited, of so many emitted photons, and counts that; once.
  virtual void build(uint64_t /*emitted*/, RenderStatistics&) {}
};

}  // namespace vpm
