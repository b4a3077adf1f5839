// Shadow rays.
#include "path/direct_light.h"

namespace vpm {

int pick_light(const Scene& scene, float u) {
  int picked = -1;
  for (size_t i = 0; i < scene.light_probability.size(); ++i) {
    if (scene.light_probability[i] == 0.0f) continue;
    picked = static_cast<int>(i);  // the last lit one also catches what rounding leaves of u
    if (u < scene.light_probability[i]) break;
    u -= scene.light_probability[i];
  }
  return picked;
}

Rgb visibility(const Scene& scene, const TransmittanceEstimator& transmittance, Ray ray, float distance, int light, MediumId medium,
               Rng& rng, WalkCounters& counters) {
  Rgb result(1.0f);
  for (;;) {
    const std::optional<Hit> hit = meet(scene, ray, distance, medium, counters);
    if (medium != kVacuum) {
      const TransmittanceEstimate t = transmittance.estimate(scene.media[medium], ray, {0.0f, hit ? hit->t : distance}, rng);
      counters.lookups += t.lookups;
      result *= t.value;
    }
    if (!hit || scene.shapes[hit->shape].light == light) return result;
    if (!is_boundary(scene.material_of(*hit)) || is_black(result)) return Rgb(0.0f);
    const float gone = hit->t;
    cross_boundary(scene, *hit, ray, medium, counters);
    distance -= gone;
  }
}

DirectSample sample_direct(const Scene& scene, int light, const TransmittanceEstimator& transmittance, const Vec3& point, const Vec3& facing,
                           MediumId medium, Rng& rng, WalkCounters& counters) {
  const std::optional<Incident> incident = sample_towards(scene.lights[light], point, rng);
  if (!incident) return {};
  DirectSample sample{incident->direction, incident->irradiance};
  if (is_black(sample.irradiance) || (facing != Vec3(0.0f) && glm::dot(facing, incident->direction) <= 0.0f)) return {};
  sample.irradiance *= visibility(scene, transmittance, {point, incident->direction}, incident->distance, light, medium, rng, counters);
  return sample;
}

}  // namespace vpm
