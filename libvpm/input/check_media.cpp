// Following media along rays through the scene.
#include "input/check_media.h"

#include <algorithm>

#include "base/rng.h"
#include "base/warp.h"

namespace vpm {
namespace {

constexpr uint64_t kRays = 64;         // through each shape
constexpr int kMostEncounters = 1000;  // along one ray

struct Tally {
  int hits = 0;
  int contradictions = 0;
  MediaContradiction last;
};

/// Counts the encounter for its first shape. Returns the medium behind all of them, or nothing where they contradict
/// `current`.
std::optional<MediumId> follow(const Scene& scene, const Encounter& met, const Vec3& direction, MediumId current,
                               std::vector<Tally>& tallies) {
  const Hit& first = met.hits[0];
  Tally& tally = tallies[first.shape];
  ++tally.hits;
  bool agrees = false;
  for (int i = 0; i < met.count; ++i)
    agrees =
        agrees || medium_beyond(scene.shapes[met.hits[i].shape], met.hits[i].normal, -direction, current) == current;
  if (agrees) return medium_after(scene, met, direction, current);
  ++tally.contradictions;
  const MediumId declared = medium_beyond(scene.shapes[first.shape], first.normal, -direction, current);
  tally.last = {first.shape, glm::dot(direction, first.normal) < 0.0f, current, declared};
  return std::nullopt;
}

void send_ray(const Scene& scene, const Vec3& target, const Vec3& direction, std::vector<Tally>& tallies) {
  const float start = glm::distance(target, scene.bounds.centre()) + 0.55f * scene.bounds.diagonal();
  Ray ray{target - start * direction, direction};
  MediumId medium = scene.world_medium;
  for (int i = 0; i < kMostEncounters; ++i) {
    const Encounter met = scene.geometry.division(ray);
    if (!met) return;
    const std::optional<MediumId> next = follow(scene, met, direction, medium, tallies);
    if (!next) return;
    medium = *next;
    ray.origin = leave_surfaces(met, direction);
  }
}

}  // namespace

std::optional<MediaContradiction> find_media_contradiction(const Scene& scene) {
  std::vector<Tally> tallies(scene.shapes.size());
  for (uint32_t shape = 0; shape < scene.shapes.size(); ++shape) {
    if (!scene.shapes[shape].separates_media) continue;
    const Box& box = scene.geometry.bounds(shape);
    for (uint64_t i = 0; i < kRays; ++i) {
      Rng rng(0, rng_stream(RngUse::probe, 1 + shape), i);
      const Vec3 target = glm::mix(box.lo, box.hi, Vec3(rng.uniform(), rng.uniform(), rng.uniform()));
      send_ray(scene, target, uniform_sphere(rng.uniform2()), tallies);
    }
  }
  const auto wrong = std::find_if(tallies.rbegin(), tallies.rend(),
                                  [](const Tally& t) { return t.contradictions > std::max(1, t.hits / 50); });
  return wrong == tallies.rend() ? std::nullopt : std::optional(wrong->last);
}

}  // namespace vpm
