// Small density grids made of functions, for tests.
#pragma once

#include <glm/gtc/matrix_transform.hpp>

#include "vpm/medium/make_grid.h"

namespace vpm {

/// A rotated, sheared, mirrored transform with anisotropic voxels away from the origin.
inline Mat4d awkward_transform() {
  Mat4d m = glm::translate(Mat4d(1.0), Vec3d(3.0, -2.0, 1.5));
  m = glm::rotate(m, 0.7, glm::normalize(Vec3d(1.0, 2.0, -0.5)));
  m = glm::scale(m, Vec3d(0.05, -0.08, 0.11));
  m[1][0] += 0.01;
  return m;
}

/// A cheap hash of a lattice point in [0, 1).
inline double lattice_noise(int x, int y, int z) {
  uint32_t h = static_cast<uint32_t>(x) * 73856093u ^ static_cast<uint32_t>(y) * 19349663u ^
               static_cast<uint32_t>(z) * 83492791u;
  h = (h ^ (h >> 13)) * 0x5bd1e995u;
  return (h ^ (h >> 15)) * 0x1p-32;
}

}  // namespace vpm
