// What a scene derives from its parts, and which medium fills a point.
#include "vpm/scene/scene.h"

#include <algorithm>
#include <cassert>

#include "vpm/base/error.h"
#include "vpm/base/rng.h"
#include "vpm/light/emitting_volume.h"

namespace vpm {

namespace {

/// Directions of no symmetry, so that they do not run along the faces and edges that scenes are made of.
const Vec3 kProbes[] = {glm::normalize(Vec3(0.5470f, 0.7316f, 0.4071f)),
                        glm::normalize(Vec3(-0.6133f, 0.3319f, 0.7168f)),
                        glm::normalize(Vec3(0.2843f, -0.8429f, -0.4567f))};

/// The near side of a shape that is no other one's far side: what a ray of unknown past comes out of.
MediumId came_from(const Scene& scene, const Encounter& met, const Vec3& direction) {
  const auto side = [&](int i, const Vec3& d) {
    return medium_beyond(scene.shapes[met.hits[i].shape], met.hits[i].normal, d, kVacuum);
  };
  for (int i = 0; i < met.count; ++i) {
    bool entered = false;
    for (int j = 0; j < met.count; ++j) entered = entered || (j != i && side(j, direction) == side(i, -direction));
    if (!entered) return side(i, -direction);
  }
  return side(0, -direction);
}

MediumId medium_along(const Scene& scene, const Ray& ray) {
  const Encounter met = scene.geometry.division(ray);
  return met ? came_from(scene, met, ray.direction) : scene.world_medium;
}

Box wider_box(const Box& box) {
  if (box.empty()) return {Vec3(-std::sqrt(1.0f / 3.0f)), Vec3(std::sqrt(1.0f / 3.0f))};
  // A little wider than the shapes, so that light from infinity starts outside in spite of rounding, and a floor alone
  // has a volume to enter.
  const float margin = 1e-6f * glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi)));
  return {box.lo - margin, box.hi + margin};
}

std::optional<Period> period_of(const Scene& scene) {
  if (scene.cyclic == std::array<bool, 3>{}) return std::nullopt;
  const Box shapes = scene.geometry.bounds();
  Box box = scene.bounds;
  for (const Detector& detector : scene.detectors) {
    const Box around = bounds_of(detector);
    if (!around.empty()) box.add(around);  // what leaves the shapes goes on repeating itself up to there
  }
  for (int a = 0; a < 3; ++a)
    if (scene.cyclic[static_cast<size_t>(a)]) {
      box.lo[a] = shapes.lo[a];
      box.hi[a] = shapes.hi[a];
    }
  return Period(box, scene.cyclic);
}

bool all_grey(const Scene& scene) {
  return std::all_of(scene.lights.begin(), scene.lights.end(), [](const Light& l) { return is_grey(l); }) &&
         std::all_of(scene.media.begin(), scene.media.end(), [](const Medium& m) { return m.grey(); }) &&
         std::all_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) { return is_grey(m); }) &&
         std::all_of(scene.textures.begin(), scene.textures.end(), [](const auto& t) { return !t || t->grey(); });
}

std::vector<double> probability_by_power(const Scene& scene) {
  std::vector<double> power;
  double total = 0.0;
  for (const Light& light : scene.lights)
    total += power.emplace_back(mean_channel(light_power(light, entrance_of(scene, light))));
  if (scene.lights.empty()) return {};
  if (!(total > 0.0) || std::isinf(total)) {
    throw InputError("lights: their power is " + std::to_string(total) + " W in all, it must be positive and finite");
  }
  std::vector<double> probability;
  probability.reserve(power.size());
  for (const double p : power) probability.push_back(p / total);
  return probability;
}

/// What a medium emits where it is, W: by drawn places, unless all of these are inside. Where few are, more are drawn.
Rgb power_inside(const Scene& scene, const VolumeLight& light) {
  constexpr uint64_t kPlaces = 4096, kMostPlaces = 1 << 18, kFewInside = 1000;
  Rgbd inside(0.0);
  uint64_t places = 0, found = 0;
  for (; places < kPlaces || (places < kMostPlaces && found < kFewInside); ++places) {
    Rng rng(0, rng_stream(RngUse::probe, 1), places);
    const double choice = rng.uniform_double(), x = rng.uniform_double();
    const EmittingVolume::Place place = light.volume->draw(choice, x, rng.uniform2());
    if (medium_along(scene, {place.position, kProbes[0]}) != light.medium) continue;
    ++found;
    inside += emission_coefficient(scene.media[light.medium], place.position) / place.bound;
  }
  const Rgb whole = light.volume->power();
  if (found == places && !is_black(whole)) return whole;
  constexpr double kLeast = 1e-6;  // of the bound: one that no place shows is still a light
  if (inside == Rgbd(0.0)) return Rgb(static_cast<float>(kLeast * light.volume->bound()));
  return Rgb(light.volume->bound() / static_cast<double>(places) * inside);
}

/// Does a boundary between media cut the box? Judged by segments between random points in it: a cut that parts off a
/// share f of the box is overlooked with probability about (1 - 2 f)^256.
bool is_cut(const Scene& scene, const Box& box) {
  constexpr uint64_t kSegments = 256;
  for (uint64_t i = 0; i < kSegments; ++i) {
    Rng rng(0, rng_stream(RngUse::probe, 0), i);
    const auto point = [&] { return glm::mix(box.lo, box.hi, Vec3(rng.uniform(), rng.uniform(), rng.uniform())); };
    const Vec3 from = point(), to = point();
    if (from == to) return false;
    const Ray ray{from, glm::normalize(to - from)};
    const Encounter met = scene.geometry.division(ray);
    if (met && met.hits[0].t < glm::distance(from, to)) return true;
  }
  return false;
}

/// The medium that all photons of a light start in: one where no boundary cuts the light.
MediumId medium_of(const Scene& scene, const Light& light) {
  if (std::holds_alternative<VolumeLight>(light)) return kSeveralMedia;  // its cells may lie anywhere
  const std::optional<LightPlace> place = light_place(light);
  if (!place) return scene.world_medium;
  return is_cut(scene, place->bounds) ? kSeveralMedia : medium_around(scene, place->point);
}

}  // namespace

MediumId medium_before(const Scene& scene, const Encounter& met, const Vec3& direction, MediumId current) {
  for (int i = 0; i < (met.surface ? 1 : met.count); ++i)
    if (medium_beyond(scene.shapes[met.hits[i].shape], met.hits[i].normal, -direction, current) == current)
      return current;
  return came_from(scene, met, direction);
}

MediumId medium_after(const Scene& scene, const Encounter& met, const Vec3& direction, MediumId current) {
  bool crossed[Encounter::kMost] = {};
  for (int round = 0; round < met.count; ++round)
    for (int i = 0; i < met.count; ++i) {
      const Shape& shape = scene.shapes[met.hits[i].shape];
      if (crossed[i] || medium_beyond(shape, met.hits[i].normal, -direction, current) != current) continue;
      crossed[i] = true;
      current = medium_beyond(shape, met.hits[i].normal, direction, current);
    }
  return current;
}

void finish(Scene& scene) {
  assert(scene.light_probability.empty() && scene.light_medium.empty());
  assert(scene.textures.size() <= scene.materials.size());
  scene.bounds = wider_box(scene.geometry.bounds());
  scene.period = period_of(scene);
  scene.grey = all_grey(scene);
  for (Light& light : scene.lights)
    if (auto* volume = std::get_if<VolumeLight>(&light)) volume->power = power_inside(scene, *volume);
  scene.light_probability = probability_by_power(scene);
  for (Material& material : scene.materials)
    set_facet_loss(material, scene.facet_losses.emplace_back(facet_loss_of(material)).get());
  for (const Light& light : scene.lights) scene.light_medium.push_back(medium_of(scene, light));
  scene.medium_light.assign(scene.media.size(), -1);
  for (size_t i = 0; i < scene.lights.size(); ++i)
    if (const auto* volume = std::get_if<VolumeLight>(&scene.lights[i]))
      scene.medium_light[static_cast<size_t>(volume->medium)] = static_cast<int>(i);
}

Box entrance_of(const Scene& scene, const Light& light) {
  const auto* const parallel = std::get_if<DirectionalLight>(&light);
  return scene.period && parallel ? scene.period->entrance(parallel->direction) : scene.bounds;
}

MediumId medium_at(const Scene& scene, const Vec3& point) {
  const MediumId a = medium_along(scene, {point, kProbes[0]});
  const MediumId b = medium_along(scene, {point, kProbes[1]});
  const MediumId c = medium_along(scene, {point, kProbes[2]});
  return b == c ? b : a;
}

MediumId medium_around(const Scene& scene, const Vec3& point) {
  // On a boundary, rays to its two sides find different media.
  for (const Vec3& probe : kProbes)
    if (medium_along(scene, {point, probe}) != medium_along(scene, {point, -probe})) return kSeveralMedia;
  return medium_at(scene, point);
}

MediumId medium_of_ray(const Scene& scene, MediumId place, const Ray& ray) {
  return place == kSeveralMedia ? medium_along(scene, ray) : place;
}

}  // namespace vpm
