// Photon beams that pass the rays of a camera: the search of one pass, with building what is searched.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>

#include "benchmarks/bench.h"
#include "benchmarks/room.h"
#include "vpm/base/clock.h"
#include "vpm/photon/map/ray_lanes.h"

namespace vpm::bench {
namespace {

constexpr double kTarget = 2.0, kTolerance = 1e-4;

struct Problem {
  const char* name;
  float sigma_t;  // 1/m
  float radius;   // m
};
constexpr Problem kProblems[] = {
    {"thick fog, half a pixel", 10.0f, 0.0015f}, {"thick fog, wide", 10.0f, 0.006f}, {"thin fog", 0.5f, 0.0015f}};

constexpr size_t kTogether = 64;

RayBundle bundle_of(const Vec3& apex, std::span<const EyeRay> rays) {
  std::array<Vec3, kTogether> directions;
  float farthest = 0.0f;
  for (size_t i = 0; i < rays.size(); ++i) {
    directions[i] = rays[i].ray.direction;
    farthest = std::max(farthest, rays[i].interval.t1);
  }
  return {apex, {directions.data(), rays.size()}, farthest};
}

Crossings cross(const PhotonBeamMap& map, float radius, const std::vector<EyeRay>& rays) {
  const float inverse = 1.0f / (radius * radius);
  return sum_over_rays(rays.size(), 1, [&](size_t i) {
    Crossings all;
    map.visit_crossings(rays[i].ray, rays[i].interval, [&](const BeamCrossings& found) {
      all.count += found.size;
      for (size_t k = 0; k < found.size; ++k)
        all.sum += double{found.g[k] * (1.0f - found.distance2[k] * inverse) / found.sine[k]};
    });
    return all;
  });
}

/// The same for the rays of 8 x 8 pixels at once, which room_rays() has one after another.
Crossings cross_together(const PhotonBeamMap& map, float radius, const std::vector<EyeRay>& rays) {
  return sum_over_rays(rays.size() / kTogether, 1, [&](size_t block) {
    const std::span<const EyeRay> together(rays.data() + block * kTogether, kTogether);
    const Vec3 apex = together.front().ray.origin;
    thread_local PhotonBeamMap::Selection near;
    map.select(bundle_of(apex, together), near);
    Crossings all;
    for (size_t first = 0; first < kTogether; first += kBlock) {
      const std::span<const EyeRay> some = together.subspan(first, kBlock);
      RayLanes lanes;
      for (size_t i = 0; i < kBlock; ++i) lanes.set(i, some[i].ray, some[i].interval, apex);
      near.visit_near_bundle(bundle_of(apex, some), [&](const BundledBeams& beams) {
        LaneMask count{};
        Floats sum{};
        for (size_t p = 0; p < beams.size; ++p) {
          const CrossingLanes found = cross(beams, p, lanes, radius);
          const Floats each = beams.g[p] * (1.0f - found.distance2 * (1.0f / (radius * radius))) / sqrt(found.sine2);
          count -= found.met;
          sum += select(found.met, each, 0.0f);
        }
        for (size_t i = 0; i < kBlock; ++i) {
          all.count += static_cast<size_t>(count[i]);
          all.sum += double{sum[i]};
        }
      });
    }
    return all;
  });
}

/// What is asked of every index.
struct Pass {
  const std::vector<PhotonBeam>& beams;
  const std::vector<PhotonBeam>& pieces;  // of the beams
  const std::vector<EyeRay>& rays;
  float radius;  // m
};

/// Embree's index of the beams, or of their pieces.
struct Peer {
  const char* name;
  EmbreeBeams kind;
  bool cut;
};
constexpr Peer kPeers[] = {{"Embree, user geometry by 16 rays, beams", EmbreeBeams::user_packets, false},
                           {"Embree, user geometry by 16 rays, pieces", EmbreeBeams::user_packets, true},
                           {"Embree, user geometry, beams", EmbreeBeams::user_geometry, false},
                           {"Embree, user geometry, pieces", EmbreeBeams::user_geometry, true},
                           {"Embree, flat curves, beams", EmbreeBeams::flat_curves, false},
                           {"Embree, flat curves, pieces", EmbreeBeams::flat_curves, true}};

using Cross = Crossings(const PhotonBeamMap& map, float radius, const std::vector<EyeRay>& rays);

std::function<double()> ours(const Pass& pass, Cross& cross_all, int threads) {
  return [=, &cross_all] {
    set_threads(threads);
    return cross_all(PhotonBeamMap(pass.beams, pass.radius, 1.0f), pass.radius, pass.rays).sum;
  };
}

std::function<double()> theirs(const Pass& pass, const Peer& peer, int threads) {
  return [=] {
    set_threads(threads);
    return make_embree_beams(peer.kind, peer.cut ? pass.pieces : pass.beams, pass.radius, threads)
        ->cross(pass.rays)
        .sum;
  };
}

/// How the time of a pass is spent on one thread. Throws where others find something else.
void note_parts(Bench& bench, const Pass& pass, const std::vector<Peer>& peers) {
  const Stopwatch building;
  const PhotonBeamMap map(pass.beams, pass.radius, 1.0f);
  const double built = building.seconds();
  const Crossings found = cross(map, pass.radius, pass.rays);
  bench.note("vpm, PhotonBeamMap, building", built, "s");
  bench.note("vpm, PhotonBeamMap, asking ray by ray", building.seconds() - built, "s");
  const Stopwatch asking;
  const Crossings together = cross_together(map, pass.radius, pass.rays);
  bench.note("vpm, PhotonBeamMap, asking for 64 rays together", asking.seconds(), "s");
  bench.note("crossings that these find beyond",
             static_cast<double>(together.count) / static_cast<double>(found.count) - 1.0, "of all");
  bench.note("vpm, PhotonBeamMap, memory", static_cast<double>(map.memory_bytes()) / static_cast<double>(map.size()),
             "bytes/beam");
  const auto of_rays = static_cast<double>(pass.rays.size()), of_all = static_cast<double>(found.count);
  bench.note("crossings of a ray", of_all / of_rays, "");
  for (const Peer& peer : peers) {
    const Stopwatch peer_building;
    const auto index = make_embree_beams(peer.kind, peer.cut ? pass.pieces : pass.beams, pass.radius, 1);
    const double peer_built = peer_building.seconds();
    const Crossings peer_found = index->cross(pass.rays);
    const std::string name = peer.name;
    bench.note(name + ", building", peer_built, "s");
    bench.note(name + ", asking", peer_building.seconds() - peer_built, "s");
    const double more = static_cast<double>(peer_found.count) / of_all - 1.0,
                 brighter = peer_found.sum / found.sum - 1.0;
    bench.note(name + ", crossings found beyond ours", more, "of all");
    bench.note(name + ", their sum beyond ours", brighter, "of all");
    if (std::max(std::abs(more), std::abs(brighter)) > kTolerance)
      throw std::runtime_error(name + " finds other beams");
  }
}

void measure_problem(Bench& bench, const Problem& problem, size_t count) {
  const Scene scene = foggy_room(problem.sigma_t);
  Stopwatch tracing;
  const std::vector<PhotonBeam> beams = room_beams(scene, count);
  fmt::print("\n{}, radius {} m\n", problem.name, problem.radius);
  bench.note("tracing, on one thread", tracing.seconds(), "s");
  const std::vector<EyeRay> rays = room_rays(scene);
  double length = 0.0;
  for (const PhotonBeam& beam : beams) length += double{beam.length};
  const double mean = length / static_cast<double>(count);
  bench.note("mean length of a beam", mean, "m");
  const std::vector<PhotonBeam> pieces = cut_beams(beams, std::max(8.0 * double{problem.radius}, mean / 2.0));
  const Pass pass{beams, pieces, rays, problem.radius};
  // The quickest of Embree's are compared, all others asked once. Where beams are long, the others take minutes.
  std::vector<Peer> quickest(kPeers, kPeers + 2), all(std::begin(kPeers), std::end(kPeers));
  if (mean > 0.2) all = quickest = {kPeers[1]};
  note_parts(bench, pass, all);
  for (const int threads : {1, 2}) {
    Comparison comparison{fmt::format("Photon beams, {}, threads: {}", problem.name, threads),
                          "pass",
                          1.0,
                          kTolerance,
                          Clock::wall,
                          {{"vpm, PhotonBeamMap, 64 rays together", ours(pass, cross_together, threads)},
                           {"vpm, PhotonBeamMap, ray by ray", ours(pass, cross, threads)}}};
    for (const Peer& peer : quickest)
      comparison.alternatives.push_back({peer.name, theirs(pass, peer, threads), kTarget});
    bench.compare(comparison);
  }
  set_threads(1);
}

}  // namespace

void measure_beams(Bench& bench, const Sizes& sizes) {
  for (const Problem& problem : kProblems) measure_problem(bench, problem, std::min<size_t>(sizes.photons, 1'000'000));
}

}  // namespace vpm::bench
