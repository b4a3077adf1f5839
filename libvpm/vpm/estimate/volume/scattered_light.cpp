// One shadow ray's worth of light, scattered.
#include "vpm/estimate/volume/scattered_light.h"

namespace vpm {

LightSource ScatteredOnce::draw(Rng& rng) const {
  const PickedLight picked = pick_light(scene_, rng.uniform_double());
  return {picked, draw_light_point(scene_.lights[picked.number], rng)};
}

Rgb ScatteredOnce::towards_eye(const LightSource& light, const EyeSegment& segment, const Vec3& point,
                               EyeWork& work) const {
  count(work.counters.shadow_rays);
  const ShadowRays rays{scene_, *transmittance_, work.rng, work.counters.walk};
  const DirectSample sample = sample_direct(rays, light.picked.number, {point, segment.number}, light.from);
  if (is_black(sample.irradiance)) return Rgb(0.0f);
  const float phase = phase_value(segment.medium()->phase, -sample.direction, -segment.ray.direction);
  return sample.irradiance * phase / light.picked.probability;
}

}  // namespace vpm
