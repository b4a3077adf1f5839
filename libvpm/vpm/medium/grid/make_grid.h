// Density grids made of functions: for studies and tests.
#pragma once

#include <glm/gtc/matrix_transform.hpp>
#include <memory>

#include "vpm/medium/medium.h"

namespace vpm {

/// Voxels with indices from -reach to reach along each axis, `voxel` metres apart, the middle one at the origin.
inline GridFrame centered_frame(int reach, double voxel, Interpolation interpolation = Interpolation::trilinear) {
  GridFrame frame;
  frame.lo = Vec3i(-reach);
  frame.hi = Vec3i(reach);
  frame.index_to_world = glm::scale(Mat4d(1.0), Vec3d(voxel));
  frame.interpolation = interpolation;
  return frame;
}

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
    return DensityGrid::Filled::all;
  });
}

/// A medium of that extinction coefficient (per unit density) and albedo, isotropic, over a grid, or homogeneous where
/// it is null.
inline Medium make_medium(std::shared_ptr<const DensityGrid> grid, const Rgb& sigma_t, float albedo = 0.5f) {
  Medium medium;
  medium.sigma_t = sigma_t;
  medium.sigma_s = albedo * sigma_t;
  medium.phase = Isotropic{};
  medium.grid = std::move(grid);
  return medium;
}

}  // namespace vpm
