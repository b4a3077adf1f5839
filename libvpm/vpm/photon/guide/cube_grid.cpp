// The size of cubes, and means over neighbours.
#include "vpm/photon/guide/cube_grid.h"

namespace vpm {

CubeGrid::CubeGrid(const Box& box, int resolution) : box_(box) {
  const Vec3 extent = box.extent();
  edge_ = max_channel(extent) / static_cast<float>(resolution);
  size_ = glm::max(Vec3i(1), Vec3i(glm::ceil(extent / edge_ - 1e-3f)));
}

void CubeGrid::average(std::vector<float>& field, size_t values) const {
  for (int axis = 0; axis < 3; ++axis) average_along(axis, field, values);
}

void CubeGrid::average_along(int axis, std::vector<float>& field, size_t values) const {
  const std::vector<float> before = field;
  Vec3i cube;
  for (cube.z = 0; cube.z < size_.z; ++cube.z)
    for (cube.y = 0; cube.y < size_.y; ++cube.y)
      for (cube.x = 0; cube.x < size_.x; ++cube.x) {
        Vec3i lower = cube, upper = cube;
        lower[axis] = std::max(cube[axis] - 1, 0);
        upper[axis] = std::min(cube[axis] + 1, size_[axis] - 1);
        const float* below = &before[number(lower) * values];
        const float* middle = &before[number(cube) * values];
        const float* above = &before[number(upper) * values];
        float* mean = &field[number(cube) * values];
        for (size_t i = 0; i < values; ++i) mean[i] = 0.25f * (below[i] + 2.0f * middle[i] + above[i]);
      }
}

}  // namespace vpm
