// The cloud that media are measured in.
#include "benchmarks/cloud.h"

#include "vpm/base/warp.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/medium/grid/procedural.h"

namespace vpm::bench {
namespace {

constexpr int kResolution = 256;
constexpr float kFreePaths = 40.0f;

Cloud make_cloud() {
  const ProceduralField& field = *find_procedural_field("cloud");
  const Vec3d size(field.world_size);
  const double voxel = std::max(size.x, std::max(size.y, size.z)) / (kResolution - 1);
  Cloud cloud;
  cloud.count = Vec3i(glm::floor(size / voxel + 1e-6)) + 1;
  for (int z = 0; z < cloud.count.z; ++z)
    for (int y = 0; y < cloud.count.y; ++y)
      for (int x = 0; x < cloud.count.x; ++x)
        cloud.values.push_back(field.value(Vec3(0.5 + (Vec3d(x, y, z) - 0.5 * Vec3d(cloud.count - 1)) * voxel / size)));
  GridFrame frame;
  frame.hi = cloud.count - 1;
  cloud.grid = make_grid(frame, [&](int x, int y, int z) { return cloud.value({x, y, z}); });
  return cloud;
}

}  // namespace

const Cloud& cloud() {
  static const Cloud made = make_cloud();
  return made;
}

CloudRays cloud_rays(size_t count) {
  const Vec3 size(cloud().count - 1);
  const float radius = 0.5f * glm::length(size);
  CloudRays result;
  result.length = 2.0f * radius;
  for (size_t i = 0; i < count; ++i) {
    Rng rng(1, rng_stream(RngUse::probe, 0), i);
    const Vec3 origin = 0.5f * size + radius * uniform_sphere(rng.uniform2());
    const Vec3 target = size * Vec3(rng.uniform(), rng.uniform(), rng.uniform());
    result.rays.push_back({origin, glm::normalize(target - origin)});
  }
  return result;
}

Medium cloud_medium() {
  const float edge = static_cast<float>(kResolution - 1);
  return make_medium(cloud().grid, Rgb(kFreePaths / (edge * cloud().grid->max_density())));
}

}  // namespace vpm::bench
