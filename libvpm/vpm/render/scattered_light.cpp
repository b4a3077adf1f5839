// One shadow ray's worth of light, scattered.
#include "vpm/render/scattered_light.h"

namespace vpm {

Rgb scattered_light(const EyeContext& context, const LightSource& source, const Receiver& point, const Vec3& travel,
                    Rng& rng, EyeCounters& counters) {
  count(counters.shadow_rays);
  const DirectSample light = sample_direct({context.scene, *context.transmittance, rng, counters.walk},
                                           source.picked.number, point, source.from);
  if (is_black(light.irradiance)) return Rgb(0.0f);
  const Medium& medium = context.scene.media[point.medium];
  return light.irradiance * phase_value(medium.phase, -light.direction, -travel) / source.picked.probability;
}

}  // namespace vpm
