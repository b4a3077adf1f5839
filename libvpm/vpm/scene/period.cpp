// The sides of a period, and the way from one to the other.
#include "vpm/scene/period.h"

#include <algorithm>

namespace vpm {

Period::Period(const Box& box, const std::array<bool, 3>& axes) : box_(box), axes_(axes) {
  constexpr float kInset = 1e-6f;  // floats resolve a tenth of that
  for (int a = 0; a < 3; ++a) {
    if (!repeats(a)) continue;
    const float inset = kInset * std::max({box.extent()[a], std::abs(box.lo[a]), std::abs(box.hi[a])});
    box_.lo[a] += inset;
    box_.hi[a] -= inset;
  }
}

Period::Side Period::next_side(const Ray& ray) const {
  Side next;
  for (int a = 0; a < 3; ++a) {
    const float p = ray.origin[a], d = ray.direction[a];
    if (!repeats(a)) {
      if ((p >= box_.hi[a] && d >= 0.0f) || (p <= box_.lo[a] && d <= 0.0f)) return {};
      continue;
    }
    if (d == 0.0f) continue;
    const float distance = ((d > 0.0f ? box_.hi[a] : box_.lo[a]) - p) / d;
    if (distance < next.distance) next = {a, distance};
  }
  return next;
}

float Period::to_side(const Ray& ray) const {
  constexpr float kLeast = 1e-30f;  // of what starts just beyond a side
  return std::max(kLeast, next_side(ray).distance);
}

void Period::cross(Ray& ray) const {
  const int axis = next_side(ray).axis;
  if (axis >= 0) ray.origin[axis] = ray.direction[axis] > 0.0f ? box_.lo[axis] : box_.hi[axis];
}

Box Period::entrance(const Vec3& direction) const {
  Box face = box_;
  for (int a = 0; a < 3; ++a)
    if (!repeats(a)) (direction[a] < 0.0f ? face.lo : face.hi)[a] = (direction[a] < 0.0f ? box_.hi : box_.lo)[a];
  return face;
}

}  // namespace vpm
