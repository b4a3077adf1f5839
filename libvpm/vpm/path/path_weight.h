// What a path weighs among others: one number for the whole path, so that its events do not count as samples of their
// own.
#pragma once

#include <cmath>

#include "vpm/base/statistics.h"
#include "vpm/path/walk.h"

namespace vpm {

/// The weight of largest magnitude that a path has at any of its events, over what it started with. Paths that meet no
/// medium are of weight 1 by construction: as samples they would hide how few paths make up what is seen of media.
class PathWeight {
 public:
  /// The path has that weight on arrival at an event.
  void meet(double weight, const Event& event) {
    if (std::fabs(weight) > std::fabs(largest_)) largest_ = weight;
    through_medium_ |= event.through_medium;
  }
  /// The path has ended.
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
