// Scouts, then photons, both followed from mirror to mirror.
#include "vpm/photon/caustics.h"

#include <algorithm>
#include <optional>

#include "vpm/base/parallel.h"
#include "vpm/path/follow.h"
#include "vpm/photon/emission.h"

namespace vpm {
namespace {

constexpr size_t kCausticChunk = 4096;  // photons traced one after another
// Scouts for each photon, and at most: enough for ten to find what a ten thousandth of all emission meets.
constexpr uint64_t kScouts = 4, kMostScouts = 100'000;

uint64_t scouts_of(uint64_t emitted) { return kScouts * std::min(emitted, kMostScouts / kScouts); }

/// The photon that an emission leads to, if it is a caustic one.
std::optional<Photon> follow_caustic(const Scene& scene, const DistanceStrategy& strategy, const EmissionPoint& point,
                                     int max_events, Rng& rng) {
  WalkCounters counters;
  std::optional<Photon> photon;
  bool direct = true;
  const auto see = [&](const Event& event, const PathState&, const PathState& at) {
    if (event.kind != EventKind::surface || !is_finite(at.throughput) || is_black(at.throughput)) return false;
    const bool rough = is_rough(scene.material_of(event.hit));
    if (rough && !direct) photon = {event.hit.position, PackedDirection(at.ray.direction), at.throughput};
    direct = false;
    return !rough;
  };
  follow({scene, strategy, counters, max_events}, emit_photon(scene, point), rng, PhotonVisitor{see});
  return photon;
}

}  // namespace

double caustic_paths(uint64_t emitted) {
  return static_cast<double>(emitted) + static_cast<double>(scouts_of(emitted));
}

std::vector<Photon> trace_caustics(const Scene& scene, const DistanceStrategy& strategy,
                                   const CausticSettings& settings) {
  const auto score = [&](const EmissionPoint& point, Rng& rng) {
    const std::optional<Photon> photon = follow_caustic(scene, strategy, point, settings.max_events, rng);
    if (!photon) return 0.0f;
    return sum_channels(photon->power) * (settings.importance ? settings.importance->at(photon->position) : 1.0f);
  };
  const EmissionGuide guide = EmissionGuide::learn(scouts_of(settings.emitted), settings.seed,
                                                   rng_stream(RngUse::caustic_scout, settings.pass), score);
  std::vector<std::vector<Photon>> parts(chunk_count(settings.emitted, kCausticChunk));
  parallel_for_chunks(settings.emitted, kCausticChunk, [&](size_t begin, size_t end, size_t chunk) {
    for (size_t i = begin; i < end; ++i) {
      Rng rng(settings.seed, rng_stream(RngUse::caustic, settings.pass), i);
      const EmissionGuide::Sample drawn = guide.sample(rng);
      std::optional<Photon> photon = follow_caustic(scene, strategy, drawn.point, settings.max_events, rng);
      if (!photon) continue;
      photon->power /= drawn.density;
      parts[chunk].push_back(*photon);
    }
  });
  std::vector<Photon> all;
  for (const std::vector<Photon>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace vpm
