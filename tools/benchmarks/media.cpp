// Media, measured in the cloud: look-ups of density, free flights, transmittance.
#include <algorithm>

#include "benchmarks/bench.h"
#include "benchmarks/cloud.h"
#include "vpm/medium/distance/strategy.h"
#include "vpm/medium/transmittance/estimator.h"

namespace vpm::bench {

// Density look-ups in the cloud.
namespace {

struct Combs {
  std::vector<Comb> combs;
  std::vector<Vec3> points;  // the same places, comb after comb
};

Combs combs_along_rays() {
  const CloudRays rays = cloud_rays(2000);
  const Vec3 hi(cloud().count - 1);
  Combs result;
  for (const Ray& ray : rays.rays) {
    Comb comb{ray, 0.0f, 0};
    for (float t = 0.5f; t < rays.length; ++t)
      if (const Vec3 p = ray.at(t); Box{Vec3(0.0f), hi}.contains(p)) {
        if (comb.count++ == 0) comb.first = t;
        result.points.push_back(p);
      }
    result.combs.push_back(comb);
  }
  return result;
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

/// As marching estimators of transmittance do: what they look up is known in advance.
double sum_combs(std::span<const Comb> combs) {
  const DensityGrid& grid = *cloud().grid;
  double sum = 0.0;
  float densities[DensityAlong::kAtOnce];
  for (const auto& [ray, first, count] : combs) {
    const DensityAlong along(&grid, ray);
    for (size_t i = 0; i < count; i += DensityAlong::kAtOnce) {
      const size_t here = std::min(count - i, DensityAlong::kAtOnce);
      along.at(first + static_cast<double>(i), 1.0, {densities, here});
      for (size_t k = 0; k < here; ++k) sum += densities[k];
    }
  }
  return sum;
}

/// The same one by one, as tracking does.
double sum_combs_singly(std::span<const Comb> combs) {
  const DensityGrid& grid = *cloud().grid;
  double sum = 0.0;
  for (const auto& [ray, first, count] : combs) {
    const DensityAlong along(&grid, ray);
    for (size_t i = 0; i < count; ++i) sum += along.at(first + static_cast<double>(i));
  }
  return sum;
}

template <class Place>
std::function<double()> over(const std::vector<Place>& places,
                             const std::function<double(std::span<const std::type_identity_t<Place>>)>& sum) {
  if (!sum) return {};
  return [&places, sum] { return sum(places); };
}

void compare(Bench& bench, const std::string& title, std::vector<Alternative> alternatives,
             const std::vector<Vec3>& points) {
  alternatives.push_back({"vpm, DensityGrid::density", over(points, sum_densities)});
  alternatives.push_back({"NanoVDB, sampler with a cache", over(points, nanovdb_sampler())});
  alternatives.push_back({"OpenVDB, BoxSampler over an accessor", over(points, openvdb_accessor())});
  alternatives.push_back({"OpenVDB, GridSampler", over(points, openvdb_grid_sampler())});
  bench.compare({title, "look-up", static_cast<double>(points.size()), 1e-5, Clock::processor, alternatives});
}

}  // namespace

void measure_lookups(Bench& bench, const Sizes&) {
  const auto [combs, points] = combs_along_rays();
  compare(bench, "Look-ups along rays, a voxel apart, cloud of 256^3",
          {{"vpm, DensityAlong, sixteen at once", over(combs, sum_combs)},
           {"NanoVDB, sampler with a cache, each ray taken into the grid", over(combs, nanovdb_along_rays()), 5.0},
           {"vpm, DensityAlong, one by one", over(combs, sum_combs_singly)}},
          points);
  compare(bench, "Look-ups at random, cloud of 256^3", {}, random_points());
}

// Free flights through the cloud, from outside to the first collision or the far side.
namespace {

std::function<double()> flights_by(const std::string& name, const Medium& medium, const CloudRays& rays) {
  const std::shared_ptr<const DistanceStrategy> strategy = make_distance_strategy({.strategy = name});
  return [strategy, &medium, &rays] {
    double sum = 0.0;
    for (size_t i = 0; i < rays.rays.size(); ++i) {
      Rng rng(1, rng_stream(RngUse::photon, 0), i);
      sum += strategy->sample(medium, rays.rays[i], {0.0f, rays.length}, Rgb(1.0f), rng).t;
    }
    return sum;
  };
}

}  // namespace

void measure_flights(Bench& bench, const Sizes&) {
  const CloudRays rays = cloud_rays(40'000);
  const Medium medium = cloud_medium();
  const auto ours = [&](const char* name) { return flights_by(name, medium, rays); };
  std::function<double()> nanovdb;
  if (const SumFlights sum = nanovdb_flights()) nanovdb = [&, sum] { return sum(rays, medium.sigma_t.r); };
  // Alternatives draw independent numbers: a sum of 40 000 flights errs by about 0.4 %.
  bench.compare({"Free flights, cloud of 256^3",
                 "flight",
                 static_cast<double>(rays.rays.size()),
                 0.02,
                 Clock::processor,
                 {{"vpm, delta-local", ours("delta-local")},
                  {"vpm, regular", ours("regular")},
                  {"NanoVDB, HDDA under leaf majorants", nanovdb, 1.8},
                  {"vpm, delta: one majorant", ours("delta"), 2.5}}});
}

// Transmittance estimators along rays through the whole cloud.
void measure_transmittance(Bench& bench, const Sizes&) {
  const CloudRays rays = cloud_rays(20'000);
  const Medium medium = cloud_medium();
  // One sample a ray: the noisiest sums err by about 1 %.
  Comparison comparison{
      "Transmittance, cloud of 256^3", "ray", static_cast<double>(rays.rays.size()), 0.05, Clock::processor, {}};
  for (const EstimatorInfo& info : transmittance_estimators()) {
    TransmittanceSettings settings;
    settings.estimator = info.name;
    const std::shared_ptr<const TransmittanceEstimator> estimator = make_transmittance_estimator(settings);
    comparison.alternatives.push_back(
        {"vpm, " + std::string(info.name), [estimator, &medium, &rays] {
           double sum = 0.0;
           for (size_t i = 0; i < rays.rays.size(); ++i) {
             Rng rng(1, rng_stream(RngUse::photon, 0), i);
             sum += estimator->estimate(medium, rays.rays[i], {0.0f, rays.length}, rng).value.r;
           }
           return sum;
         }});
  }
  bench.compare(comparison);
}

}  // namespace vpm::bench
