// Merging ledgers. Sums of floating-point numbers, so that clients, which have the header, bring no copy of it.
#include "vpm/photon/ledger.h"

namespace vpm {

void Ledger::merge(const Ledger& other) { merge_counters(*this, other); }

}  // namespace vpm
