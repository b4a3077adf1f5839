// Cells of directions about an axis, measured without rounding away narrow angles.
#pragma once

#include <algorithm>
#include <cmath>

#include "vpm/base/vec.h"

namespace vpm {

/// 1 - the cosine between two unit vectors, from their difference or sum: exact at both ends.
inline double away_from(const Vec3& axis, const Vec3& direction) {
  const Vec3d apart = Vec3d(direction) - Vec3d(axis), together = Vec3d(direction) + Vec3d(axis);
  const double near = glm::dot(apart, apart), far = glm::dot(together, together);
  return near <= far ? 0.5 * near : 2.0 - 0.5 * far;
}

inline constexpr size_t kSectors = 6;  // of the azimuth, equal

/// The number of the sector in which a direction lies about an axis: azimuths as in direction_about().
inline size_t sector_about(const Vec3& axis, const Vec3& direction) {
  Vec3 s, t;
  make_frame(axis, s, t);
  const double turn = std::atan2(glm::dot(direction, t), glm::dot(direction, s)) / (2.0 * kPiD);
  return std::min(static_cast<size_t>((turn < 0.0 ? turn + 1.0 : turn) * kSectors), kSectors - 1);
}

/// The number of the cell, of `count` equal ones, in which `x` in [0, 1] lies.
inline size_t cell_of(double x, size_t count) {
  return std::min(static_cast<size_t>(std::max(0.0, x) * static_cast<double>(count)), count - 1);
}

}  // namespace vpm
