// Small density grids made of functions, for tests, and density fields along one ray, for those of free flights.
#pragma once

#include <glm/gtc/matrix_transform.hpp>

#include "vpm/medium/grid/make_grid.h"

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

struct FlightField {
  const char* name;
  std::shared_ptr<const DensityGrid> grid;
};

/// Grids over x in (-1, 1) along the ray, voxels of 1/8 m; of 1/32 m the fine one, whose bricks inside hold nothing but
/// its values, at least 1/2.
inline std::vector<FlightField> flight_fields() {
  const GridFrame frame = centered_frame(7, 0.125);
  GridFrame boxes = frame;
  boxes.interpolation = Interpolation::nearest;
  const GridFrame fine = centered_frame(31, 0.03125);
  return {
      {"constant", make_grid(frame, [](int, int, int) { return 0.8; })},
      {"ramp", make_grid(frame, [](int x, int, int) { return 0.1 * (x + 8); })},
      {"checker", make_grid(boxes, [](int x, int y, int z) { return (x + y + z) & 1 ? 1.5 : 0.3; })},
      {"sparse", make_grid(frame, [](int x, int, int) { return x == -4 || x == 5 ? 2.0 : 0.0; })},
      {"gaussian", make_grid(frame, [](int x, int y, int z) { return std::exp(-0.05 * (x * x + y * y + z * z)); })},
      {"random", make_grid(frame, [](int x, int y, int z) { return lattice_noise(x, y, z); })},
      {"fine", make_grid(fine, [](int x, int y, int z) { return 0.5 + 0.01 * (x + 31) + lattice_noise(x, y, z); })}};
}

inline const Ray kRay{Vec3(-1.3f, 0.03f, -0.06f), glm::normalize(Vec3(1.0f, 0.02f, 0.05f))};
inline const Interval kReach{0.0f, 2.7f};

}  // namespace vpm
