// Density look-ups in the cloud.
#include "benchmarks/bench.h"
#include "benchmarks/density_peers.h"

namespace vpm::bench {
namespace {

/// Points of the cloud's box a voxel apart along rays, ray after ray.
std::vector<Vec3> points_along_rays() {
  const CloudRays rays = cloud_rays(2000);
  const Vec3 hi(cloud().count - 1);
  std::vector<Vec3> points;
  for (const Ray& ray : rays.rays)
    for (float t = 0.5f; t < rays.length; ++t)
      if (const Vec3 p = ray.at(t); Box{Vec3(0.0f), hi}.contains(p)) points.push_back(p);
  return points;
}

std::vector<Vec3> random_points() {
  Rng rng(1, rng_stream(RngUse::probe, 1), 0);
  std::vector<Vec3> points(200'000);
  for (Vec3& p : points) p = Vec3(cloud().count - 1) * Vec3(rng.uniform(), rng.uniform(), rng.uniform());
  return points;
}

double sum_densities(std::span<const Vec3> points) {
  const DensityGrid& grid = *cloud().grid;
  double sum = 0.0;
  for (const Vec3& p : points) sum += grid.density(p);
  return sum;
}

void compare(Bench& bench, const std::string& title, const std::vector<Vec3>& points, double target) {
  const auto over_points = [&](const SumDensities& sum) -> std::function<double()> {
    if (!sum) return {};
    return [&points, sum] { return sum(points); };
  };
  bench.compare({title,
                 "look-up",
                 static_cast<double>(points.size()),
                 1e-5,
                 Clock::processor,
                 {{"vpm, DensityGrid::density", over_points(sum_densities)},
                  {"NanoVDB, sampler with a cache", over_points(nanovdb_sampler()), target},
                  {"OpenVDB, BoxSampler over an accessor", over_points(openvdb_accessor())},
                  {"OpenVDB, GridSampler", over_points(openvdb_grid_sampler())}}});
}

}  // namespace

void measure_lookups(Bench& bench, const Sizes&) {
  compare(bench, "Look-ups along rays, a voxel apart, cloud of 256^3", points_along_rays(), 3.5);
  compare(bench, "Look-ups at random, cloud of 256^3", random_points(), 0.0);
}

}  // namespace vpm::bench
