// Density grids out of arrays in memory: what a program hands over in the place of a .vdb file.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "vpm/input/grid/grid_file.h"

namespace vpm {

/// The values of voxels (0, 0, 0) to count - 1, in memory of somebody else's: that of voxel (i, j, k) stands at
/// values[i * strides[0] + j * strides[1] + k * strides[2]]. Outside, the density is 0.
struct GridValues {
  const float* values = nullptr;
  Vec3i count{0};                      // voxels along each axis
  std::array<ptrdiff_t, 3> strides{};  // from one voxel to the next, in values
  Mat4d index_to_world{1.0};           // affine; its columns in m: where voxel (i, j, k) lies

  float at(const Vec3i& voxel) const {
    return values[voxel.x * strides[0] + voxel.y * strides[1] + voxel.z * strides[2]];
  }
};

/// The values as a density, the same bits as load_grid() reads from the file of write_grid(): its box is that of the
/// values which are not 0. Of the request only the interpolation, clamp_negative and object_to_world count. Throws
/// InputError for what cannot be a density: no value above 0, NaN, infinite or negative values, a transform that is
/// not affine, not finite or flat, a box whose table of bricks would take over 256 MiB.
LoadedGrid density_of(const GridValues& values, const GridRequest& request);

/// A hash of the values and their place, 16 hex digits.
std::string hash_of(const GridValues& values);

}  // namespace vpm
