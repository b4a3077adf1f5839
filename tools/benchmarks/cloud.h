// The cloud that media are measured in, in index coordinates: 1 m is a voxel. And other libraries' density grids,
// filled with it.
#pragma once

#include <functional>
#include <memory>
#include <span>
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

/// A ray's places in the cloud's box, a voxel apart from `first` on.
struct Comb {
  Ray ray;
  float first;  // m
  size_t count;
};

/// The sum of densities at points, and at the places of rays, each taken into the grid once.
using SumDensities = std::function<double(std::span<const Vec3>)>;
using SumCombs = std::function<double(std::span<const Comb>)>;
/// The sum of the lengths of free flights of a sigma_t at density 1, 1/m; ray i draws from Rng(1, stream, i).
using SumFlights = std::function<double(const CloudRays&, float sigma_t)>;

/// OpenVDB: BoxSampler over an accessor, and GridSampler over the tree.
SumDensities openvdb_accessor();
SumDensities openvdb_grid_sampler();

/// NanoVDB; empty where it is not installed: the sampler that keeps the corners of its last cell, and flights through
/// null collisions under the leaves' largest densities, which HDDA steps through.
SumDensities nanovdb_sampler();
SumCombs nanovdb_along_rays();
SumFlights nanovdb_flights();

}  // namespace vpm::bench
