// Keeping some of many records, so that they stand for all.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/base/rng.h"

namespace vpm {

/// Keeps no more than `most` records, those of all media together; 0: all. They are evenly spaced in the list of all,
/// from a random place on, and take the power of those between them: sums over records stay what they are in the mean.
/// Returns the share that is kept.
template <class Record>
float thin(std::vector<std::vector<Record>>& by_medium, uint64_t most, Rng& rng) {
  uint64_t all = 0;
  for (const std::vector<Record>& records : by_medium) all += records.size();
  if (most == 0 || all <= most) return 1.0f;
  const double step = static_cast<double>(all) / static_cast<double>(most);
  double next = step * rng.uniform_double();
  uint64_t number = 0;
  for (std::vector<Record>& records : by_medium) {
    size_t kept = 0;
    for (const Record& record : records) {
      if (number++ != static_cast<uint64_t>(next)) continue;
      records[kept] = record;
      records[kept++].power *= static_cast<float>(step);
      next += step;
    }
    records.resize(kept);
  }
  return static_cast<float>(1.0 / step);
}

}  // namespace vpm
