// Photons within a fixed radius: what every gather of a photon map costs.
#include "vpm/photon/radius_map.h"

#include <fmt/format.h>

#include "benchmarks/bench.h"
#include "benchmarks/photons.h"
#include "benchmarks/point_peers.h"

namespace vpm::bench {
namespace {

struct Targets {
  double nanoflann = 0.0, embree = 0.0;
};

void compare(Bench& bench, size_t count, const Targets& targets) {
  const std::vector<Photon> photons = random_photons(count);
  const float radius = neighbour_radius(count);
  const RadiusMap map(photons, radius, 1.0f);
  const auto nanoflann = make_nanoflann_index(photons), embree = make_embree_index(photons);

  const auto measure = [&](const char* order, const std::vector<Vec3>& queries, const Targets& aims) {
    const auto ours = [&] {
      double sum = 0.0;
      for (const Vec3& q : queries)
        map.visit_near(q, radius, [&](const NearPhotons& near) {
          for (size_t i = 0; i < near.size(); ++i) sum += radius * radius - near.distances2()[i];
        });
      return sum;
    };
    const auto theirs = [&](const PointIndex* index) -> std::function<double()> {
      if (!index) return {};
      return [&, index] { return index->sum_near(queries, radius); };
    };
    bench.compare(
        {fmt::format("About {} photons of {:.0e} within a radius, {}", kNeighbours, static_cast<double>(count), order),
         "query",
         static_cast<double>(queries.size()),
         1e-5,
         Clock::processor,
         {{"vpm, RadiusMap", ours},
          {"nanoflann, radius", theirs(nanoflann.get()), aims.nanoflann},
          {"Embree, rtcPointQuery", theirs(embree.get()), aims.embree}}});
  };
  const std::vector<Vec3> queries = random_queries(50'000);
  measure("queries in random order", queries, {});
  measure("queries sorted by Morton code", morton_sorted(queries), targets);
}

}  // namespace

void measure_radius(Bench& bench, const Sizes& sizes) {
  if (sizes.photons >= 1'000'000) compare(bench, 1'000'000, {10.0, 8.0});
  if (sizes.photons >= 10'000'000) compare(bench, 10'000'000, {7.0, 5.0});
}

}  // namespace vpm::bench
