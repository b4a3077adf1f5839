// Shadow rays.
#include "vpm/path/direct_light.h"

#include <cassert>

#include "vpm/base/counters.h"
#include "vpm/light/emitting_volume.h"
#include "vpm/path/emission_along.h"

namespace vpm {
namespace {

/// The visitor of a shadow ray.
struct ShadowRay {
  const ShadowRays& rays;
  Ray ray;
  MediumId medium;
  int light;       // that it is sent to; -1: to a place
  int shape;       // that this place is on; -1: on none
  float distance;  // of the target from the ray's origin, m
  Vec3 target;     // m
  Rgb transmittance{1.0f};

  bool pass(float length, const Encounter& met) {
    if (medium != kVacuum) {
      const Medium& around = rays.scene.media[medium];
      const TransmittanceEstimate t = rays.transmittance.estimate(around, ray, {0.0f, length}, rays.rng);
      count(rays.counters.lookups, t.lookups);
      count(rays.counters.bricks, t.bricks);
      transmittance *= t.value;
    }
    return met && !is_black(transmittance) && !is_target(met.hits[0]);
  }
  bool is_target(const Hit& hit) const {
    const bool looked_for =
        light >= 0 ? rays.scene.shapes[hit.shape].light == light : static_cast<int>(hit.shape) == shape;
    return looked_for && stands_at(hit, ray, distance);
  }

  /// Not > 0 where a light stands just behind a boundary: they were passed together.
  float left(const Ray& behind) {
    if (distance < kInfinity) distance = glm::dot(target - behind.origin, behind.direction);
    return distance;
  }
};

Rgb transmittance_to_target(ShadowRay shadow) {
  const bool blocked =
      each_segment(shadow.rays.scene, shadow.ray, shadow.medium, shadow.distance, shadow.rays.counters, shadow)
          .has_value();
  return blocked ? Rgb(0.0f) : shadow.transmittance;
}

}  // namespace

PickedLight pick_light(const Scene& scene, double u) {
  assert(!scene.lights.empty());
  PickedLight picked;
  for (size_t i = 0; i < scene.light_probability.size(); ++i) {
    const double probability = scene.light_probability[i];
    if (probability == 0.0) continue;
    // The last lit one also catches what rounding leaves of u.
    picked = {static_cast<int>(i), static_cast<float>(probability)};
    if (u < probability) break;
    u -= probability;
  }
  return picked;
}

Receiver near_side(const Hit& hit, const Vec3& travel, MediumId medium) {
  const Vec3 normal = glm::dot(hit.normal, travel) < 0.0f ? hit.normal : -hit.normal;
  return {leave_surface(hit, normal), medium, normal};
}

Receiver far_side(const Scene& scene, const Hit& hit, const Vec3& travel, MediumId medium) {
  const Vec3 normal = glm::dot(hit.normal, travel) < 0.0f ? -hit.normal : hit.normal;
  return {leave_surface(hit, normal), medium_beyond(scene.shapes[hit.shape], hit.normal, normal, medium), normal};
}

Rgb visibility(const ShadowRays& rays, Ray ray, float distance, int light, MediumId medium) {
  return transmittance_to_target({rays, ray, medium, light, -1, distance, ray.at(distance)});
}
Rgb visibility_of_place(const ShadowRays& rays, Ray ray, float distance, MediumId medium, int shape) {
  return transmittance_to_target({rays, ray, medium, -1, shape, distance, ray.at(distance)});
}

namespace {

bool is_behind(const Receiver& receiver, const Vec3& direction) {
  return receiver.normal != Vec3(0.0f) && glm::dot(receiver.normal, direction) <= 0.0f;
}

/// A place of the medium gives the direction; what comes from there is all that the medium emits along the ray
/// [Simon2017; Villemin2013].
DirectSample sample_medium(const ShadowRays& rays, const VolumeLight& light, const Receiver& receiver) {
  const double choice = rays.rng.uniform_double(), x = rays.rng.uniform_double();
  const Vec3 towards = light.volume->draw(choice, x, rays.rng.uniform2()).position - receiver.point;
  const float distance = glm::length(towards);
  if (!(distance > 0.0f)) return {};
  const Ray ray{receiver.point, towards / distance};
  if (is_behind(receiver, ray.direction)) return {};
  DirectSample sample{ray.direction, Rgb(0.0f), static_cast<float>(light.volume->direction_density(ray))};
  if (!(sample.pdf > 0.0f)) return {};
  sample.irradiance = emission_of(light.medium, rays.scene, ray, receiver.medium, rays.counters) / sample.pdf;
  return sample;
}

}  // namespace

DirectSample sample_direct(const ShadowRays& rays, int light, const Receiver& receiver,
                           const std::optional<LightPoint>& from) {
  const Light& source = rays.scene.lights[light];
  if (const auto* volume = std::get_if<VolumeLight>(&source)) return sample_medium(rays, *volume, receiver);
  const std::optional<Incident> incident =
      from ? sample_towards(source, *from, receiver.point, rays.rng) : sample_towards(source, receiver.point, rays.rng);
  if (!incident) return {};
  if (is_behind(receiver, incident->direction)) return {};
  DirectSample sample{incident->direction, incident->irradiance, incident->pdf};
  if (is_black(sample.irradiance)) return {};
  sample.irradiance *=
      visibility(rays, {receiver.point, incident->direction}, incident->distance, light, receiver.medium);
  return sample;
}

}  // namespace vpm
