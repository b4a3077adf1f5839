// The weight of a path as one sample: one number for the whole path, so that its events do not count as separate
// samples.
#pragma once

#include <cmath>

#include "vpm/base/statistics/moments.h"
#include "vpm/path/walk.h"

namespace vpm {

/// The weight of largest magnitude that a path has at any of its events, relative to its weight at the start. A path
/// that meets no medium has weight 1 by construction. It is not counted as a sample, because such paths would hide how
/// few paths contribute to the light from media.
class PathWeight {
 public:
  /// Notes the path's weight on arrival at an event.
  void meet(double weight, const Event& event) {
    if (std::fabs(weight) > std::fabs(largest_)) largest_ = weight;
    through_medium_ |= event.through_medium;
  }
  /// Adds the path, which has ended. A path that met no medium can only raise the largest weight.
  void add_to(WeightMoments& weights) const {
    if (through_medium_)
      weights.add(largest_);
    else
      weights.at_least(largest_);
  }

 private:
  double largest_ = 0.0;
  bool through_medium_ = false;
};

}  // namespace vpm
