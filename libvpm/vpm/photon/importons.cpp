// Importons in fixed chunks, their tracks added in the chunks' order.
#include "vpm/photon/importons.h"

#include <algorithm>

#include "vpm/base/parallel.h"
#include "vpm/path/follow.h"

namespace vpm {
namespace {

constexpr int kResolution = 32;                  // cubes of importance along the scene's longest edge
constexpr int kDirectionResolution = 16;         // those of directions: each takes the memory of many
constexpr size_t kImportonChunk = 4096;          // importons traced one after another
constexpr uint64_t kWave = 32 * kImportonChunk;  // those whose tracks wait to be added

void merge(Importance& all, const Importance& part) {
  all.map.merge(part.map);
  if (all.directions) all.directions->merge(*part.directions);
}

/// Follows one importon and adds its tracks. Those from the camera to what it sees, by mirrors and glass or straight,
/// tell of no direction for photons: what a photon leaves where the camera sees it is seen from there.
void trace_importon(const Scene& scene, const DistanceStrategy& strategy, Rng& rng, int max_events,
                    Importance& importance) {
  const Camera& camera = scene.camera;
  const Vec2 film = rng.uniform2() * Vec2(camera.width, camera.height);
  const Ray seen = camera.ray(film);
  WalkCounters counters;
  bool scattered = false;
  const auto see = [&](const Event& event, const PathState& from, PathState& at) {
    if (!is_finite(at.throughput)) return false;
    const bool escaped = event.kind == EventKind::escape;
    const float length = escaped ? kInfinity : glm::distance(from.ray.origin, at.ray.origin);
    if (length > 0.0f) {
      const float weight = mean_channel(from.throughput);
      importance.map.add_track(from.ray, length, weight);
      if (importance.directions && scattered) importance.directions->add_track(from.ray, length, weight);
    }
    const double now = mean_channel(at.throughput);
    if (escaped || !(now > 0.0) || !survive_roulette(now, at, rng)) return false;
    scattered |= event.kind == EventKind::collision || is_rough(scene.material_of(event.hit));
    return true;
  };
  const MediumId medium = medium_of_ray(scene, scene.camera_medium, seen);
  follow({scene, strategy, counters, max_events}, {seen, medium, Rgb(1.0f)}, rng, EyeVisitor{see});
}

}  // namespace

Importance trace_importons(const Scene& scene, const DistanceStrategy& strategy, const GuideSettings& settings,
                           uint64_t seed, uint64_t pass, int max_events) {
  Box box = scene.bounds;
  box.add(scene.camera.position);
  Importance all{ImportanceMap(box, kResolution), {}};
  if (settings.scatter) all.directions.emplace(box, kDirectionResolution);
  const Importance none = all;
  for (uint64_t first = 0; first < settings.importons; first += kWave) {
    const uint64_t wave = std::min(kWave, settings.importons - first);
    std::vector<Importance> parts(chunk_count(wave, kImportonChunk), none);
    parallel_for_chunks(wave, kImportonChunk, [&](size_t begin, size_t end, size_t chunk) {
      for (uint64_t i = first + begin; i < first + end; ++i) {
        Rng rng(seed, rng_stream(RngUse::importon, pass), i);
        trace_importon(scene, strategy, rng, max_events, parts[chunk]);
      }
    });
    for (const Importance& part : parts) merge(all, part);
  }
  all.map.finish();
  if (all.directions) all.directions->finish();
  return all;
}

}  // namespace vpm
