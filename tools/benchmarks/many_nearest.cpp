// Estimates over thousands of nearest photons: in a closed room, at what the pixels of tiles see.
#include <fmt/format.h>

#include "benchmarks/bench.h"
#include "benchmarks/room.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/photon/records.h"

namespace vpm::bench {
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
