// Other libraries' density grids, filled with the cloud.
#pragma once

#include <functional>
#include <span>

#include "benchmarks/cloud.h"
#include "vpm/base/vec.h"

namespace vpm::bench {

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
