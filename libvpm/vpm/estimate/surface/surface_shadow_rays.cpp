// Every light, on the side that is seen, and from behind where the material scatters through.
#include "vpm/estimate/surface/surface_shadow_rays.h"

#include "vpm/base/count.h"
#include "vpm/surface/shading.h"

namespace vpm {

Rgb SurfaceShadowRays::sent(const SurfaceView& view, EyeWork& work) const {
  Rgb result = sent(view, near_side(view.hit, view.travel, view.medium), work);
  if (scatters_through(view.material)) result += sent(view, far_side(scene_, view.hit, view.travel, view.medium), work);
  return result;
}

/// Of the light that arrives on that side.
Rgb SurfaceShadowRays::sent(const SurfaceView& view, const Receiver& side, EyeWork& work) const {
  Rgb result(0.0f);
  for (int i = 0; i < static_cast<int>(scene_.lights.size()); ++i) {
    count(work.counters.shadow_rays);
    const DirectSample light = sample_direct({scene_, *transmittance_, work.rng, work.counters.walk}, i, side);
    if (is_black(light.irradiance)) continue;
    const ScatterValue scattered = scatter_value(view.material, view.hit, view.travel, light.direction);
    result += scattered.value * scattered.radiance_scale * light.irradiance;
  }
  return result;
}

}  // namespace vpm
