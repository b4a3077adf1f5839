// Photon maps: building them, and finding photons by radius, by count, and by thousands.
#include <fmt/format.h>

#include <algorithm>

#include "benchmarks/bench.h"
#include "benchmarks/photons.h"
#include "benchmarks/room.h"
#include "vpm/base/parallel.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/photon/map/nearest_map.h"
#include "vpm/photon/map/radius_map.h"
#include "vpm/photon/records.h"

namespace vpm::bench {

// Building photon maps.
void measure_build(Bench& bench, const Sizes& sizes) {
  set_threads(2);
  const size_t count = std::min<size_t>(sizes.photons, 10'000'000);
  const std::vector<Photon> photons = random_photons(count);
  const float radius = neighbour_radius(count);
  const auto number = static_cast<double>(count);
  const auto radius_map = [&] { return static_cast<double>(RadiusMap(photons, radius, 1.0f).size()); };
  const auto nearest_map = [&] { return static_cast<double>(NearestMap(photons, 1.0f).size()); };
  // nanoflann 1.4 builds on one thread.
  std::function<double()> nanoflann;
  if (make_nanoflann_index({photons[0]}))
    nanoflann = [&] {
      make_nanoflann_index(photons);
      return number;
    };
  bench.compare({fmt::format("Building a map of {:.0e} photons, ours on 2 threads", number),
                 "photon",
                 number,
                 0.0,
                 Clock::wall,
                 {{"vpm, RadiusMap", radius_map}, {"nanoflann", nanoflann, 10.0}}});
  bench.compare({fmt::format("Building a map of {:.0e} photons for the nearest, ours on 2 threads", number),
                 "photon",
                 number,
                 0.0,
                 Clock::wall,
                 {{"vpm, NearestMap", nearest_map}, {"nanoflann", nanoflann, 4.0}}});
}

// Photons within a fixed radius: what every gather of a photon map costs.
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

// The k nearest photons: adaptive radii.
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

// Estimates over thousands of nearest photons: in a closed room, at what the pixels of tiles see.
namespace {

constexpr uint32_t kMany = 10'000;
constexpr size_t kSeenTiles = 16, kTilePixels = 256;  // of a tile

/// What eye rays meet, tile after tile, from all over the picture.
std::vector<Hit> seen(const Scene& scene) {
  const std::vector<EyeRay> rays = room_rays(scene);
  std::vector<Hit> hits;
  for (size_t tile = 0; tile < kSeenTiles; ++tile)
    for (size_t pixel = 0; pixel < kTilePixels; ++pixel)
      hits.push_back(*scene.geometry.intersect(rays[tile * rays.size() / kSeenTiles + pixel].ray));
  return hits;
}

}  // namespace

void measure_many_nearest(Bench& bench, const Sizes& sizes) {
  const size_t emitted = std::min<size_t>(1'000'000, sizes.photons);
  const Scene scene = foggy_room(0.0f);
  ListSettings tracing;
  tracing.emitted = emitted;
  const std::vector<Photon> photons = list_photons(scene, *make_distance_strategy({}), tracing).surface;
  const GatherSettings gather{.mode = GatherMode::nearest, .radius = 1.0f, .count = kMany};
  const PhotonMap plain = make_photon_map(photons, gather, emitted);
  PhotonMap prepared = plain;
  prepared.prepare_sums_by_nodes();
  const std::vector<Hit> hits = seen(scene);

  const auto sum = [&](const PhotonMap& map) {
    GatherCounters counters;
    Neighbours neighbours;
    double total = 0.0;
    for (const Hit& hit : hits)
      total += surface_irradiance(hit.position, -hit.normal, CountedMap{map, {counters, neighbours}}).value.g;
    return total;
  };
  bench.compare(
      {fmt::format("The {} nearest of {:.1e} photons on walls, summed up", kMany, static_cast<double>(photons.size())),
       "photon of an estimate",
       static_cast<double>(hits.size()) * kMany,
       1e-5,
       Clock::processor,
       {{"vpm, by whole nodes", [&] { return sum(prepared); }, 0.0},
        {"vpm, photon by photon", [&] { return sum(plain); }, 5.0}}});
}

}  // namespace vpm::bench
