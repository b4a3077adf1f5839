// Rays from one point that lie side by side: maps are searched for all of them at once. Half spaces bound where photons
// count.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>

#include "vpm/base/vec.h"

namespace vpm {

/// The places that lie in each of a few half spaces; all places where there are none.
class HalfSpaces {
 public:
  static constexpr int kMost = 10;

  /// Adds the places x with normal . x >= offset, in m; at most kMost times.
  void add(const Vec3& normal, float offset) {
    assert(count_ < kMost);
    normal_[count_] = normal;
    offset_[count_++] = offset;
  }
  int count() const { return count_; }
  const Vec3& normal(int i) const { return normal_[i]; }
  float offset(int i) const { return offset_[i]; }
  bool hold(const Vec3& place) const {
    bool inside = true;
    for (int i = 0; i < count_; ++i) inside &= glm::dot(normal_[i], place) >= offset_[i];
    return inside;
  }
  /// Do all of the places lie in all of them?
  bool hold_all(const float* x, const float* y, const float* z, size_t count) const {
    uint32_t outside = 0;  // no branch, so that each loop compiles to vector instructions
    for (int k = 0; k < count_; ++k) {
      const Vec3 n = normal_[k];
      const float least = offset_[k];
      for (size_t i = 0; i < count; ++i) outside |= n.x * x[i] + n.y * y[i] + n.z * z[i] < least ? 1u : 0u;
    }
    return outside == 0;
  }
  /// Does a ball, of that radius about the place, lie in all of them?
  bool hold_ball(const Vec3& place, float radius) const {
    bool inside = true;
    for (int i = 0; i < count_; ++i) inside &= glm::dot(normal_[i], place) - radius >= offset_[i];
    return inside;
  }
  /// The part of an interval of a line that lies in all of them.
  Interval clip(const Ray& line, Interval part) const {
    for (int i = 0; i < count_; ++i) {
      const float rise = glm::dot(normal_[i], line.direction);
      const float depth = glm::dot(normal_[i], line.origin) - offset_[i];
      if (rise > 0.0f)
        part.t0 = std::max(part.t0, -depth / rise);
      else if (rise < 0.0f)
        part.t1 = std::min(part.t1, -depth / rise);
      else if (depth < 0.0f)
        part.t1 = part.t0;
    }
    return part;
  }

 private:
  std::array<Vec3, kMost> normal_;
  std::array<float, kMost> offset_;
  int count_ = 0;
};

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
