// Rays from one point that lie side by side: maps are searched for all of them at once.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "vpm/base/vec.h"
#include "vpm/photon/half_spaces.h"

namespace vpm {

/// The pyramid that rays from one point lie in.
class RayBundle {
 public:
  /// Of rays from or through `apex`, in these directions (unit), which all lie within 45 degrees of their mean and go
  /// up to `farthest` from it, m.
  RayBundle(const Vec3& apex, std::span<const Vec3> directions, float farthest);

  const Vec3& apex() const { return apex_; }
  /// The places of the rays and those between them, counted from the apex, m.
  const HalfSpaces& region() const { return region_; }

 private:
  Vec3 apex_;
  HalfSpaces region_;
};

/// How wide rays of these directions (unit) are apart at the distance 1; infinite where they are no bundle.
float spread_of(std::span<const Vec3> directions);

/// Are such rays no farther apart than `width`, m, half way between the ends of what they reach, or where light has
/// come a free path, m? Then most of what one of them finds is found by the others, too.
bool is_narrow(std::span<const Vec3> directions, const Interval& reach, float free_path, float width);

}  // namespace vpm
