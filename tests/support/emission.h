// Media that emit, for tests.
#pragma once

#include <glm/gtc/matrix_transform.hpp>

#include "support/grids.h"
#include "vpm/medium/grid/make_grid.h"

namespace vpm {

/// Values that go linearly with z, from 0 to 2 m, and are the same in x and y up to 60 m.
inline std::shared_ptr<const DensityGrid> linear_in_z(double at_zero, double at_two) {
  GridFrame frame;
  frame.index_to_world = glm::scale(Mat4d(1.0), Vec3d(2.0));
  frame.lo = Vec3i(-30, -30, 0);
  frame.hi = Vec3i(30, 30, 1);
  return make_grid(frame, [&](int, int, int z) { return z == 0 ? at_zero : at_two; });
}

/// Values on a lattice that is turned against that of emitting_grids(), about its middle.
template <class F>
std::shared_ptr<const DensityGrid> turned_grid(int reach, F&& values) {
  GridFrame frame = centered_frame(reach, 0.31);
  frame.index_to_world = glm::translate(Mat4d(1.0), Vec3d(0.3, 1.4, 2.1)) *
                         glm::rotate(Mat4d(1.0), 0.7, Vec3d(0.3, 1.0, -0.4)) * frame.index_to_world;
  return make_grid(frame, values);
}

/// The grids of S9e: 8^3 voxels of 0.25 m, of which the first lies at (-0.75, 0.5, 1.25) m.
inline Medium emitting_grids(float sigma_a, float sigma_s) {
  GridFrame frame;
  frame.index_to_world = glm::translate(Mat4d(1.0), Vec3d(-0.75, 0.5, 1.25)) * glm::scale(Mat4d(1.0), Vec3d(0.25));
  frame.lo = Vec3i(0);
  frame.hi = Vec3i(7);
  Medium medium;
  medium.name = "grids";
  medium.phase = Isotropic{};
  medium.sigma_s = Rgb(sigma_s);
  medium.sigma_t = Rgb(sigma_a + sigma_s);
  medium.grid = make_grid(frame, [](int i, int j, int k) { return (3 * i + 5 * j + 7 * k + i * j) % 11 / 8.0; });
  medium.emission = MediumEmission{.colour = Rgb(1.0f)};
  medium.emission_grid =
      make_grid(frame, [](int i, int j, int k) { return (2 * i + 3 * j + 5 * k + j * k) % 7 / 4.0; });
  return medium;
}

}  // namespace vpm
