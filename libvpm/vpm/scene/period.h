// Space that repeats itself along some axes, as slabs and clouds of atmospheric optics do: what leaves a period at one
// side enters it at the other.
#pragma once

#include <array>

#include "vpm/base/vec.h"

namespace vpm {

class Period {
 public:
  /// One period: as wide as the box along each axis that repeats itself. Its sides stand inside the box, by a millionth
  /// of its width or of its farthest coordinate, so that faces there are never met.
  Period(const Box& box, const std::array<bool, 3>& axes);

  const Box& box() const { return box_; }
  bool repeats(int axis) const { return axes_[static_cast<size_t>(axis)]; }
  /// How far the ray goes to a side, m, > 0; infinite for one that has left the box along another axis.
  float to_side(const Ray& ray) const;
  /// Moves a ray that stands at a side to the opposite one.
  void cross(Ray& ray) const;
  /// Where light from infinity along a direction enters: the face of the box that it comes to, which repeats itself
  /// along two axes.
  Box entrance(const Vec3& direction) const;

 private:
  struct Side {
    int axis = -1;               // -1: none
    float distance = kInfinity;  // m
  };
  Side next_side(const Ray& ray) const;

  Box box_;  // between the sides, and what there is along other axes
  std::array<bool, 3> axes_;
};

}  // namespace vpm
