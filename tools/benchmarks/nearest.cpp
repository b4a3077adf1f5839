// The k nearest photons: adaptive radii.
#include <fmt/format.h>

#include "benchmarks/bench.h"
#include "benchmarks/photons.h"
#include "benchmarks/point_peers.h"
#include "vpm/photon/nearest_map.h"

namespace vpm::bench {
namespace {

constexpr auto kCount = static_cast<uint32_t>(kNeighbours);

void compare(Bench& bench, size_t count) {
  const std::vector<Photon> photons = random_photons(count);
  const NearestMap map(photons, 1.0f);
  const auto nanoflann = make_nanoflann_index(photons);

  const auto measure = [&](const char* order, const std::vector<Vec3>& queries, double target) {
    const auto ours = [&] {
      Neighbours neighbours;
      double sum = 0.0;
      for (const Vec3& q : queries) {
        map.find(q, kCount, kInfinity, neighbours, [](const auto&, const Vec3&) { return true; });
        sum += std::sqrt(neighbours.limit());
      }
      return sum;
    };
    std::function<double()> theirs;
    if (nanoflann) theirs = [&] { return nanoflann->sum_nearest(queries, kCount); };
    bench.compare({fmt::format("The {} nearest of {:.0e} photons, {}", kCount, static_cast<double>(count), order),
                   "query",
                   static_cast<double>(queries.size()),
                   1e-6,
                   Clock::processor,
                   {{"vpm, NearestMap", ours}, {"nanoflann, k nearest", theirs, target}}});
  };
  const std::vector<Vec3> queries = random_queries(20'000);
  measure("queries in random order", queries, 4.0);
  measure("queries sorted by Morton code", morton_sorted(queries), 4.0);
}

}  // namespace

void measure_nearest(Bench& bench, const Sizes& sizes) {
  for (const size_t count : {size_t{1'000'000}, size_t{10'000'000}})
    if (sizes.photons >= count) compare(bench, count);
}

}  // namespace vpm::bench
