// Importons in fixed chunks, their tracks added in the chunks' order and counted by cubes; then scouts that ask where
// photons get to.
#include "vpm/photon/guide/photon_guide.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "vpm/base/parallel.h"
#include "vpm/path/follow.h"
#include "vpm/photon/emission.h"

namespace vpm {
namespace {

constexpr float kInside = 1e-3f;           // of a cube's edge: so far within it a place is surely its own
constexpr float kLeastImportance = 1e-4f;  // of the mean importance: what a cube has at least

}  // namespace

ImportanceMap::ImportanceMap(const Box& box, int resolution) : grid_(box, resolution), values_(grid_.count(), 0.0f) {}

void ImportanceMap::add_track(const Ray& ray, float length, float weight) {
  grid_.visit(ray, length, [&](size_t cube, float entered, float left) {
    values_[cube] += weight * std::max(0.0f, left - entered) / grid_.edge();
    return true;
  });
}

void ImportanceMap::merge(const ImportanceMap& other) {
  assert(values_.size() == other.values_.size());
  for (size_t i = 0; i < values_.size(); ++i) values_[i] += other.values_[i];
}

void ImportanceMap::finish() {
  grid_.average(values_, 1);
  double sum = 0.0;
  for (const float value : values_) sum += value;
  const float mean = static_cast<float>(sum / static_cast<double>(values_.size()));
  const float least = mean > 0.0f ? kLeastImportance * mean : 1.0f;
  for (float& value : values_) value = std::max(value, least);
}

float ImportanceMap::first_above(const Ray& ray, float level) const {
  float found = kInfinity;
  grid_.visit(ray, kInfinity, [&](size_t cube, float entered, float) {
    if (entered > 0.0f && values_[cube] > level) found = entered + kInside * grid_.edge();
    return found == kInfinity;
  });
  return found;
}

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
/// suggest no direction for photons: what a photon leaves where the camera sees it is seen from there.
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

PhotonGuide learn_guide(const Scene& scene, const DistanceStrategy& strategy, const GuideSettings& settings,
                        uint64_t seed, uint64_t pass, int max_events) {
  Importance importance = trace_importons(scene, strategy, settings, seed, pass, max_events);
  PhotonGuide guide{std::move(importance.map), std::move(importance.directions), {}, 0.0};
  const auto score = [&](const EmissionPoint& point, Rng& rng) {
    PathState state = emit_photon(scene, point);
    if (is_black(state.throughput)) return 0.0f;
    WalkCounters counters;
    const Event event = next_event(scene, strategy, state, rng, counters);
    if (event.kind == EventKind::escape || !is_finite(state.throughput)) return 0.0f;
    return sum_channels(state.throughput) * guide.importance.at(state.ray.origin);
  };
  guide.emission = EmissionGuide::learn(settings.importons, seed, rng_stream(RngUse::scout, pass), score);
  guide.value = guide.emission.mean_score();
  if (!settings.aim) guide.emission = EmissionGuide();
  return guide;
}

}  // namespace vpm
