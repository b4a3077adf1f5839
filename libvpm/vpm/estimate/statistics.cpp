// Merging statistics. Sums of floating-point numbers, so that clients, which have the header, bring no copy of it.
#include "vpm/estimate/statistics.h"

namespace vpm {

void EyeCounters::merge(const EyeCounters& other) { merge_counters(*this, other); }

void RenderStatistics::merge(const RenderStatistics& pass) { merge_counters(*this, pass); }

}  // namespace vpm
