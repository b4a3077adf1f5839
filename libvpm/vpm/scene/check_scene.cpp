// Following media and faces along rays through the scene; the spacing of floats where it stands.
#include "vpm/scene/check_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vpm/base/rng.h"
#include "vpm/base/warp.h"

namespace vpm {
namespace {

constexpr uint64_t kRays = 64;         // through each shape
constexpr int kMostEncounters = 1000;  // along one ray
constexpr float kParallel = 1e-3f;     // angle between the normals of faces that coincide

/// A line through the box of a shape.
struct Probe {
  Vec3 target;
  Vec3 direction;  // unit

  Ray from(float distance) const { return {target - distance * direction, direction}; }
};

Probe probe(const Scene& scene, uint32_t shape, uint64_t number) {
  const Box& box = scene.geometry.bounds(shape);
  Rng rng(0, rng_stream(RngUse::probe, 1 + shape), number);
  const Vec3 target = glm::mix(box.lo, box.hi, Vec3(rng.uniform(), rng.uniform(), rng.uniform()));
  return {target, uniform_sphere(rng.uniform2())};
}

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

void follow_media(const Scene& scene, const Probe& probe, std::vector<Tally>& tallies) {
  Ray ray = probe.from(glm::distance(probe.target, scene.bounds.center()) + 0.55f * scene.bounds.diagonal());
  MediumId medium = scene.world_medium;
  for (int i = 0; i < kMostEncounters; ++i) {
    const Encounter met = scene.geometry.division(ray);
    if (!met) return;
    const std::optional<MediumId> next = follow(scene, met, ray.direction, medium, tallies);
    if (!next) return;
    medium = *next;
    ray.origin = leave_surfaces(met, ray.direction);
  }
}

/// How far a ray stands off a surface it leaves, m: it does not meet what is nearer.
float departure(const Hit& hit) { return glm::distance(leave_surface(hit, hit.normal), hit.position); }

/// Do rays that leave one of the faces step over the other?
bool coincide(const Hit& a, const Hit& b) {
  const float apart = std::abs(glm::dot(a.normal, b.position - a.position));
  return glm::length(glm::cross(a.normal, b.normal)) < kParallel && apart <= std::max(departure(a), departure(b));
}

/// Must light meet the boundary as well as the dielectric? A dielectric that names its media says what is behind both.
bool hides(const Scene& scene, const Hit& dielectric, const Hit& boundary) {
  return is_dielectric(scene.material_of(dielectric)) && !scene.shapes[dielectric.shape].separates_media &&
         is_boundary(scene.material_of(boundary));
}

/// Must light meet both shapes?
bool both_count(const Scene& scene, const Hit& a, const Hit& b) {
  return (is_dielectric(scene.material_of(a)) && is_dielectric(scene.material_of(b))) || hides(scene, a, b) ||
         hides(scene, b, a);
}

std::optional<CommonFace> common_face_of(const Scene& scene, const Encounter& met) {
  for (int i = 0; i < met.count; ++i)
    for (int j = 0; j < i; ++j) {
      const Hit &a = met.hits[i], &b = met.hits[j];
      if (both_count(scene, a, b) && coincide(a, b))
        return CommonFace{std::max(a.shape, b.shape), std::min(a.shape, b.shape)};
    }
  return std::nullopt;
}

/// Along the line within `reach` (m) of its target.
std::optional<CommonFace> common_face_along(const Scene& scene, const Probe& probe, float reach) {
  Ray ray = probe.from(reach);
  for (int i = 0; i < kMostEncounters && glm::dot(ray.origin - probe.target, ray.direction) < reach; ++i) {
    const Encounter met = scene.geometry.faces(ray);
    if (!met) return std::nullopt;
    if (const std::optional<CommonFace> found = common_face_of(scene, met)) return found;
    ray.origin = leave_surfaces(met, ray.direction);
  }
  return std::nullopt;
}

}  // namespace

std::optional<MediaContradiction> find_media_contradiction(const Scene& scene) {
  std::vector<Tally> tallies(scene.shapes.size());
  for (uint32_t shape = 0; shape < scene.shapes.size(); ++shape) {
    if (!scene.shapes[shape].separates_media) continue;
    for (uint64_t i = 0; i < kRays; ++i) follow_media(scene, probe(scene, shape, i), tallies);
  }
  const auto wrong = std::find_if(tallies.rbegin(), tallies.rend(),
                                  [](const Tally& t) { return t.contradictions > std::max(1, t.hits / 50); });
  return wrong == tallies.rend() ? std::nullopt : std::optional(wrong->last);
}

std::optional<CommonFace> find_common_face(const Scene& scene) {
  for (uint32_t shape = 0; shape < scene.shapes.size(); ++shape) {
    const Material& material = scene.materials[scene.shapes[shape].material];
    if (!is_dielectric(material) && !is_boundary(material)) continue;
    const float reach = scene.geometry.bounds(shape).diagonal();
    for (uint64_t i = 0; i < kRays; ++i)
      if (const std::optional<CommonFace> found = common_face_along(scene, probe(scene, shape, i), reach)) return found;
  }
  return std::nullopt;
}

namespace {

/// Warns of a scene so far from the origin that the spacing of floats there shows in its shapes.
void note_unresolved_place(const Box& bounds, std::vector<std::string>& notes) {
  if (bounds.empty()) return;
  constexpr double kVisible = 1e-4;  // of the scene's size
  const Vec3 apart = glm::abs(bounds.center());
  const float far = std::max({apart.x, apart.y, apart.z});
  const double spacing = double(std::nextafter(far, kInfinity)) - far;
  if (spacing > kVisible * bounds.diagonal())
    notes.push_back(fmt::format(
        "the scene, {:.2g} m across, is {:.2g} m from the origin, where positions are {:.2g} m apart: its shapes are "
        "rounded to that; move it to the origin",
        bounds.diagonal(), glm::length(bounds.center()), spacing));
}

/// Warns of media whose free paths are shorter than floats resolve positions: what enters these does not come out
/// again.
void note_unresolved_media(const Scene& scene, std::vector<std::string>& notes) {
  constexpr double kSparse = 0.1;  // of a grid's diagonal
  const Box& bounds = scene.bounds;
  const double resolved =
      0x1p-20 * (glm::length(bounds.center()) + 0.5 * bounds.diagonal());  // m: a few units in the last place
  for (const Medium& medium : scene.media) {
    const double extinction = double(max_channel(medium.sigma_t)) * medium.max_density();  // 1/m
    if (!medium.scatters() || !(extinction * resolved > 1.0)) continue;
    const bool sparse = medium.grid && medium.grid->extent() < kSparse * medium.grid->bounds().diagonal();
    notes.push_back(fmt::format(
        "medium '{}': its free paths, down to {:.2g} m, are shorter than positions of this scene resolve, {:.2g} m: "
        "light that enters it stays there{}",
        medium.name, 1.0 / extinction, resolved,
        sparse ? "; its grid is far wider than what it holds: bound that by a shape, near the origin" : ""));
  }
}

}  // namespace

std::string doubt_of_temperatures(const Medium& medium) {
  if (!medium.emits() || !medium.emission->blackbody || !medium.emission_grid) return "";
  const double hottest = medium.emission->kelvin(double{medium.emission_grid->max_density()});
  if (hottest >= kColdestFire && hottest <= kHottestFire) return "";
  return fmt::format(
      "its temperatures reach {:.4g} K, fire has 1000 to 3000 K: 'scale' and 'offset' of 'temperature' "
      "make kelvin of the grid's values",
      hottest);
}

std::vector<std::string> notes_of(const Scene& scene) {
  std::vector<std::string> notes;
  for (const Medium& medium : scene.media) {
    if (const std::string doubt = doubt_of_temperatures(medium); !doubt.empty())
      notes.push_back("medium '" + medium.name + "': " + doubt);
    const auto* tabulated = std::get_if<Tabulated>(&medium.phase);
    if (tabulated && std::abs(tabulated->table->total() - 1.0) > 1e-3)
      notes.push_back(fmt::format(
          "medium '{}': the table of its phase function integrates to {:.6g} over the sphere, and is divided by that",
          medium.name, tabulated->table->total()));
    if (tabulated && tabulated->table->columns() > 1)
      notes.push_back(fmt::format(
          "medium '{}': its phase function is the mean of the {} columns of its table, as it has no colour of its own",
          medium.name, tabulated->table->columns()));
  }
  note_unresolved_place(scene.bounds, notes);
  note_unresolved_media(scene, notes);
  return notes;
}

}  // namespace vpm
