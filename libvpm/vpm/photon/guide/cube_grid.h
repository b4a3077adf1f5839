// Cubes over a box: which one a place is in, which ones a ray crosses, and means over neighbours.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "vpm/base/vec.h"

namespace vpm {

/// The cubes have numbers from 0. Outside the box counts the nearest cube.
class CubeGrid {
 public:
  /// `resolution` >= 1 cubes along the box's longest edge. The box has a volume.
  CubeGrid(const Box& box, int resolution);

  size_t count() const { return number(size_ - 1) + 1; }
  float edge() const { return edge_; }  // of a cube, m
  size_t number_at(const Vec3& p) const { return number(cube_at(p)); }

  /// Calls visit(number, entered, left), distances in metres, for each cube that the first `length` metres of the ray
  /// cross, until it returns false.
  template <class Visit>
  void visit(const Ray& ray, float length, Visit&& visit) const;

  /// Averages a field of so many values a cube, each with its own kind in the neighbours: once along each axis, with
  /// weights 1, 2, 1.
  void average(std::vector<float>& field, size_t values) const;

 private:
  Vec3i cube_at(const Vec3& p) const { return Vec3i(glm::clamp((p - box_.lo) / edge_, Vec3(0.0f), Vec3(size_ - 1))); }
  size_t number(const Vec3i& cube) const {
    return (static_cast<size_t>(cube.z) * static_cast<size_t>(size_.y) + static_cast<size_t>(cube.y)) *
               static_cast<size_t>(size_.x) +
           static_cast<size_t>(cube.x);
  }
  void average_along(int axis, std::vector<float>& field, size_t values) const;

  Box box_;
  Vec3i size_{1};  // cubes along each axis
  float edge_ = 1.0f;
};

template <class Visit>
void CubeGrid::visit(const Ray& ray, float length, Visit&& visit) const {
  Interval inside{0.0f, length};
  for (int a = 0; a < 3; ++a) {
    const float lo = box_.lo[a], hi = box_.lo[a] + edge_ * static_cast<float>(size_[a]);
    if (ray.direction[a] == 0.0f) {
      if (ray.origin[a] < lo || ray.origin[a] > hi) return;
      continue;
    }
    const float t_lo = (lo - ray.origin[a]) / ray.direction[a], t_hi = (hi - ray.origin[a]) / ray.direction[a];
    inside.t0 = std::max(inside.t0, std::min(t_lo, t_hi));
    inside.t1 = std::min(inside.t1, std::max(t_lo, t_hi));
  }
  if (inside.empty()) return;
  Vec3i cube = cube_at(ray.at(inside.t0));
  Vec3 next(kInfinity);  // where the ray leaves the cube along each axis, m
  for (int a = 0; a < 3; ++a)
    if (ray.direction[a] != 0.0f)
      next[a] = (box_.lo[a] + edge_ * static_cast<float>(cube[a] + (ray.direction[a] > 0.0f)) - ray.origin[a]) /
                ray.direction[a];
  for (float t = inside.t0; t < inside.t1;) {
    const int axis = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
    const float left = std::min(next[axis], inside.t1);
    if (!visit(number(cube), t, left)) return;
    t = std::max(t, left);
    cube[axis] += ray.direction[axis] > 0.0f ? 1 : -1;
    if (cube[axis] < 0 || cube[axis] >= size_[axis]) return;
    next[axis] += edge_ / std::abs(ray.direction[axis]);
  }
}

}  // namespace vpm
