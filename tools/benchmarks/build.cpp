// Building photon maps.
#include <fmt/format.h>

#include <algorithm>

#include "benchmarks/bench.h"
#include "benchmarks/photons.h"
#include "benchmarks/point_peers.h"
#include "vpm/base/parallel.h"
#include "vpm/photon/nearest_map.h"
#include "vpm/photon/radius_map.h"

namespace vpm::bench {

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

}  // namespace vpm::bench
