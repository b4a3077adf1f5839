// Shadow rays.
#include "path/direct_light.h"

#include <cassert>

namespace vpm {

int pick_light(const Scene& scene, float u) {
  int picked = -1;
  for (size_t i = 0; i < scene.light_probability.size(); ++i) {
    if (scene.light_probability[i] == 0.0f) continue;
    picked = static_cast<int>(i);  // the last lit one also catches what rounding leaves of u
    if (u < scene.light_probability[i]) break;
    u -= scene.light_probability[i];
  }
  assert(picked >= 0);
  return picked;
}

SurfaceSide near_side(const Hit& hit, const Vec3& travel, MediumId medium) {
  const Vec3 normal = glm::dot(hit.normal, travel) < 0.0f ? hit.normal : -hit.normal;
  return {leave_surface(hit, normal), normal, medium};
}

SurfaceSide far_side(const Scene& scene, const Hit& hit, const Vec3& travel, MediumId medium) {
  const Vec3 normal = glm::dot(hit.normal, travel) < 0.0f ? -hit.normal : hit.normal;
  return {leave_surface(hit, normal), normal, medium_beyond(scene.shapes[hit.shape], hit.normal, normal, medium)};
}

Rgb visibility(const Scene& scene, const TransmittanceEstimator& transmittance, Ray ray, float distance, int light,
               MediumId medium, Rng& rng, WalkCounters& counters) {
  const Vec3 target = ray.at(distance);
  Rgb result(1.0f);
  for (;;) {
    const Encounter met = meet(scene, ray, distance, medium, counters);
    const float reach = met ? met.hits[0].t : distance;
    if (medium != kVacuum) {
      const TransmittanceEstimate t = transmittance.estimate(scene.media[medium], ray, {0.0f, reach}, rng);
      counters.lookups += t.lookups;
      result *= t.value;
    }
    if (!met) return result;
    if (scene.shapes[met.hits[0].shape].light == light && stands_at(met.hits[0], ray, distance)) return result;
    if (!is_boundary(scene.material_of(met.hits[0])) || is_black(result)) return Rgb(0.0f);
    cross_boundaries(scene, met, ray, medium, counters);
    if (distance == kInfinity) continue;
    distance = glm::dot(target - ray.origin, ray.direction);
    if (!(distance > 0.0f)) return result;  // a light just behind a boundary: they were passed together
  }
}

DirectSample sample_direct(const Scene& scene, int light, const TransmittanceEstimator& transmittance,
                           const Vec3& point, const Vec3& facing, MediumId medium, Rng& rng, WalkCounters& counters) {
  const std::optional<Incident> incident = sample_towards(scene.lights[light], point, rng);
  if (!incident) return {};
  DirectSample sample{incident->direction, incident->irradiance, incident->pdf};
  if (is_black(sample.irradiance) || (facing != Vec3(0.0f) && glm::dot(facing, incident->direction) <= 0.0f)) return {};
  sample.irradiance *=
      visibility(scene, transmittance, {point, incident->direction}, incident->distance, light, medium, rng, counters);
  return sample;
}

}  // namespace vpm
