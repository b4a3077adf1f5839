// Merging of ledgers.
#include "vpm/photon/ledger.h"

namespace vpm {

void Ledger::merge(const Ledger& other) {
  emitted_count += other.emitted_count;
  emitted += other.emitted;
  absorbed_in_media += other.absorbed_in_media;
  absorbed_on_surfaces += other.absorbed_on_surfaces;
  escaped += other.escaped;
  cut += other.cut;
  cut_count += other.cut_count;
  imbalance.merge(other.imbalance);
  weights.merge(other.weights);
  collisions += other.collisions;
  surface_hits += other.surface_hits;
  floored += other.floored;
  non_finite += other.non_finite;
  walk.merge(other.walk);
}

}  // namespace vpm
