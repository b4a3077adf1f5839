// Trilinear interpolation between the corners of a brick's cell.
#pragma once

#include "vpm/base/vec.h"

namespace vpm {

/// The value at `f`, each of [0, 1], between the eight values around: values[z * slice + y * row + x], x, y and z of
/// {0, 1}. It rounds: among equal values it may leave them by some units in the last place.
inline float trilinear(const float* values, int row, int slice, const Vec3& f) {
  const auto along_x = [&](const float* edge) { return edge[0] + f.x * (edge[1] - edge[0]); };
  const auto along_y = [&](const float* face) {
    const float a = along_x(face);
    return a + f.y * (along_x(face + row) - a);
  };
  const float a = along_y(values);
  return a + f.z * (along_y(values + slice) - a);
}

}  // namespace vpm
