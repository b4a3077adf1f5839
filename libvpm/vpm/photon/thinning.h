// Keeping some of many records, so that they stand for all.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "vpm/base/rng.h"

namespace vpm {

/// Keeps no more than `most` records, those of all media together; 0: all. Of each of as many equal stretches of the
/// list of all one is drawn, and takes the power of the stretch: sums over records stay what they are in the mean. At
/// equal distances they would all be of one part of a lamp, where points of low discrepancy tell the places on it in
/// turn. Returns the share that is kept.
template <class Record>
float thin(std::vector<std::vector<Record>>& by_medium, uint64_t most, Rng& rng) {
  uint64_t all = 0;
  for (const std::vector<Record>& records : by_medium) all += records.size();
  if (most == 0 || all <= most) return 1.0f;
  const double step = static_cast<double>(all) / static_cast<double>(most);
  double begun = 0.0;      // stretches
  const auto draw = [&] {  // rounding may take a draw beyond the last record
    return begun < static_cast<double>(most)
               ? std::min(all - 1, static_cast<uint64_t>(step * (begun++ + rng.uniform_double())))
               : all;
  };
  uint64_t next = draw(), number = 0;
  for (std::vector<Record>& records : by_medium) {
    size_t kept = 0;
    for (const Record& record : records) {
      float stretches = 0.0f;  // that have drawn this one: two may share it
      for (; number == next; next = draw()) ++stretches;
      ++number;
      if (stretches == 0.0f) continue;
      records[kept] = record;
      records[kept++].power *= stretches * static_cast<float>(step);
    }
    records.resize(kept);
  }
  return static_cast<float>(1.0 / step);
}

}  // namespace vpm
