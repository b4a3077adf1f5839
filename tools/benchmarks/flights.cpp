// Free flights through the cloud, from outside to the first collision or the far side.
#include "benchmarks/bench.h"
#include "benchmarks/density_peers.h"
#include "vpm/medium/distance/strategy.h"

namespace vpm::bench {
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

}  // namespace vpm::bench
