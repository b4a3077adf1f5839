// Shadow rays.
#include "vpm/path/direct_light.h"
#include "vpm/base/count.h"

#include <cassert>

namespace vpm {

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
  const Scene& scene = rays.scene;
  const Vec3 target = ray.at(distance);
  Rgb result(1.0f);
  for (;;) {
    const Encounter met = meet(scene, ray, distance, medium, rays.counters);
    const float reach = met ? met.hits[0].t : distance;
    if (medium != kVacuum) {
      const TransmittanceEstimate t = rays.transmittance.estimate(scene.media[medium], ray, {0.0f, reach}, rays.rng);
      count(rays.counters.lookups, t.lookups);
      count(rays.counters.bricks, t.bricks);
      result *= t.value;
    }
    if (!met) return result;
    if (scene.shapes[met.hits[0].shape].light == light && stands_at(met.hits[0], ray, distance)) return result;
    if (!is_boundary(scene.material_of(met.hits[0])) || is_black(result)) return Rgb(0.0f);
    cross_boundaries(scene, met, ray, medium, rays.counters);
    if (distance == kInfinity) continue;
    distance = glm::dot(target - ray.origin, ray.direction);
    if (!(distance > 0.0f)) return result;  // a light just behind a boundary: they were passed together
  }
}

DirectSample sample_direct(const ShadowRays& rays, int light, const Receiver& receiver,
                           const std::optional<LightPoint>& from) {
  const Light& source = rays.scene.lights[light];
  const std::optional<Incident> incident =
      from ? sample_towards(source, *from, receiver.point, rays.rng) : sample_towards(source, receiver.point, rays.rng);
  if (!incident) return {};
  const bool from_everywhere = receiver.normal == Vec3(0.0f);
  if (!from_everywhere && glm::dot(receiver.normal, incident->direction) <= 0.0f) return {};
  DirectSample sample{incident->direction, incident->irradiance, incident->pdf};
  if (is_black(sample.irradiance)) return {};
  sample.irradiance *=
      visibility(rays, {receiver.point, incident->direction}, incident->distance, light, receiver.medium);
  return sample;
}

}  // namespace vpm
