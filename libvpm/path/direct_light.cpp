// Shadow rays.
#include "path/direct_light.h"

namespace vpm {

int pick_light(const Scene& scene, float u) {
  const int last = static_cast<int>(scene.light_probability.size()) - 1;
  for (int i = 0; i < last; ++i) {
    if (u < scene.light_probability[i]) return i;
    u -= scene.light_probability[i];
  }
  return last;
}

Rgb visibility(const Scene& scene, const TransmittanceEstimator& transmittance, Ray ray, float distance, int light, MediumId medium,
               Rng& rng, WalkCounters& counters) {
  Rgb result(1.0f);
  for (;;) {
    const std::optional<Hit> hit = scene.geometry.intersect(ray, distance);
    if (medium != kVacuum) {
      const TransmittanceEstimate t = transmittance.estimate(scene.media[medium], ray, {0.0f, hit ? hit->t : distance}, rng);
      counters.lookups += t.lookups;
      result *= t.value;
    }
    if (!hit || scene.shapes[hit->shape].light == light) return result;
    if (!is_boundary(scene.material_of(*hit)) || is_black(result)) return Rgb(0.0f);
    const float gone = hit->t;
    cross_surface(scene, *hit, ray, medium, counters);
    distance -= gone;
  }
}

DirectSample sample_direct(const Scene& scene, const TransmittanceEstimator& transmittance, const Vec3& point, const Vec3& facing,
                           MediumId medium, Rng& rng, WalkCounters& counters) {
  const int light = pick_light(scene, rng.uniform());
  const std::optional<Incident> incident = sample_towards(scene.lights[light], point, rng);
  if (!incident) return {};
  DirectSample sample{incident->direction, incident->irradiance / scene.light_probability[light]};
  if (is_black(sample.irradiance) || (facing != Vec3(0.0f) && glm::dot(facing, incident->direction) <= 0.0f)) return {};
  sample.irradiance *= visibility(scene, transmittance, {point, incident->direction}, incident->distance, light, medium, rng, counters);
  return sample;
}

}  // namespace vpm
