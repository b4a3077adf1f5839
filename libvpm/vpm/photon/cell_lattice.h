// Equal cells that fill a box, and the walk of a ray through them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "vpm/base/vec.h"

namespace vpm {

/// Cell (x, y, z) has the number (x * count.y + y) * count.z + z.
struct CellLattice {
  Box box;         // m, of a volume above 0
  Vec3i count{1};  // cells along each axis, each at least 1

  size_t size() const {
    return static_cast<size_t>(count.x) * static_cast<size_t>(count.y) * static_cast<size_t>(count.z);
  }
  Vec3d edges() const { return (Vec3d(box.hi) - Vec3d(box.lo)) / Vec3d(count); }  // of a cell, m
  double volume() const { return edges().x * edges().y * edges().z; }             // of a cell, m^3
  size_t number_of(const Vec3i& cell) const {
    return (static_cast<size_t>(cell.x) * static_cast<size_t>(count.y) + static_cast<size_t>(cell.y)) *
               static_cast<size_t>(count.z) +
           static_cast<size_t>(cell.z);
  }
  /// The cell that holds a place; nothing outside the box.
  std::optional<size_t> cell_at(const Vec3& place) const {
    if (!box.contains(place)) return std::nullopt;
    return number_of(nearest_cell(Vec3d(place)));
  }
  /// Calls visit(number of the cell, t0, t1), m, for each cell that the ray passes within the interval, in order.
  template <class Visit>
  void visit_along(const Ray& ray, const Interval& interval, Visit&& visit) const;

 private:
  /// Rounding may put a place just out of a face.
  Vec3i nearest_cell(const Vec3d& place) const {
    return glm::clamp(Vec3i(glm::floor((place - Vec3d(box.lo)) / edges())), Vec3i(0), count - 1);
  }
};

template <class Visit>
void CellLattice::visit_along(const Ray& ray, const Interval& interval, Visit&& visit) const {
  const Vec3d origin(ray.origin), direction(ray.direction), edge = edges();
  double begin = interval.t0, end = interval.t1;
  for (int a = 0; a < 3; ++a) {
    const double lo = box.lo[a], hi = box.hi[a];
    if (direction[a] == 0.0) {
      if (!(origin[a] >= lo && origin[a] <= hi)) return;
      continue;
    }
    const double to_lo = (lo - origin[a]) / direction[a], to_hi = (hi - origin[a]) / direction[a];
    begin = std::max(begin, std::min(to_lo, to_hi));
    end = std::min(end, std::max(to_lo, to_hi));
  }
  if (!(begin < end)) return;
  Vec3i cell = nearest_cell(origin + begin * direction), step(0);
  Vec3d next(kInfinity);  // where the ray leaves the cell along each axis
  const auto face = [&](int a) {
    const double at = double{box.lo[a]} + (cell[a] + (step[a] > 0 ? 1 : 0)) * edge[a];
    return (at - origin[a]) / direction[a];
  };
  for (int a = 0; a < 3; ++a) {
    if (direction[a] == 0.0) continue;
    step[a] = direction[a] > 0.0 ? 1 : -1;
    next[a] = face(a);
  }
  for (double t = begin; t < end;) {
    const int axis = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
    const double leaves = std::min(end, next[axis]);
    if (leaves > t) visit(number_of(cell), t, leaves);
    t = std::max(t, leaves);
    cell[axis] += step[axis];
    if (cell[axis] < 0 || cell[axis] >= count[axis]) return;
    next[axis] = face(axis);
  }
}

}  // namespace vpm
