// Small density grids made of functions, for tests.
#pragma once

#include <glm/gtc/matrix_transform.hpp>
#include <memory>

#include "medium/medium.h"

namespace vpm {

/// A grid whose voxel (i, j, k) in lo..hi has the value f(i, j, k); the background elsewhere.
template <class F>
std::shared_ptr<const DensityGrid> make_grid(const GridFrame& frame, F&& f) {
  return std::make_shared<const DensityGrid>(frame, [&](const Vec3i& origin, float* values) {
    for (int z = 0, n = 0; z < DensityGrid::kValues; ++z)
      for (int y = 0; y < DensityGrid::kValues; ++y)
        for (int x = 0; x < DensityGrid::kValues; ++x, ++n) {
          const Vec3i p = origin + Vec3i(x, y, z);
          const bool inside = glm::all(glm::greaterThanEqual(p, frame.lo)) && glm::all(glm::lessThanEqual(p, frame.hi));
          values[n] = inside ? static_cast<float>(f(p.x, p.y, p.z)) : frame.background;
        }
  });
}

/// A medium over a grid, isotropic.
inline Medium make_medium(std::shared_ptr<const DensityGrid> grid, const Rgb& sigma_t, float albedo = 0.5f) {
  Medium medium;
  medium.name = "test";
  medium.sigma_t = sigma_t;
  medium.sigma_s = albedo * sigma_t;
  medium.phase = Isotropic{};
  medium.grid = std::move(grid);
  return medium;
}

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
