// The cloud that media are measured in, in index coordinates: 1 m is a voxel.
#pragma once

#include <memory>
#include <vector>

#include "vpm/base/rng.h"
#include "vpm/base/vec.h"
#include "vpm/medium/medium.h"

namespace vpm::bench {

/// vpm's procedural cloud, as `vpm media cloud --resolution 256` samples it.
struct Cloud {
  Vec3i count{0};             // voxels along each edge
  std::vector<float> values;  // x runs fastest
  std::shared_ptr<const DensityGrid> grid;

  /// Outside it is 0.
  float value(const Vec3i& p) const {
    if (glm::any(glm::lessThan(p, Vec3i(0))) || glm::any(glm::greaterThanEqual(p, count))) return 0.0f;
    return values[(static_cast<size_t>(p.z) * count.y + p.y) * count.x + p.x];
  }
};
const Cloud& cloud();

/// Rays through the cloud, from a sphere around it to points uniform in its box, and their common length, m.
struct CloudRays {
  std::vector<Ray> rays;
  float length = 0.0f;
};
CloudRays cloud_rays(size_t count);

/// Grey, with 40 mean free paths at the largest density along the cloud's longest edge.
Medium cloud_medium();

}  // namespace vpm::bench
