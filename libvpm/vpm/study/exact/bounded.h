// Exact numbers as doubles can hold them: a value, and how far the truth may be from it.
#pragma once

#include <vector>

namespace vpm::exact {

/// |truth - value| <= error; the unit is the value's.
struct Bounded {
  double value = 0.0;
  double error = 0.0;
};

/// Values of one quantity at several places, with one bound for all of them.
struct BoundedSeries {
  std::vector<double> values;
  double error = 0.0;
};

}  // namespace vpm::exact
