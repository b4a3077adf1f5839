// Every light, on the side that is seen, and from behind where the material scatters through.
#include "vpm/integrators/photon_map/surface/surface_shadow_rays.h"

#include "vpm/base/counters.h"
#include "vpm/base/even_points.h"
#include "vpm/base/warp.h"
#include "vpm/light/emission_density.h"
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
  for (int light = 0; light < static_cast<int>(scene_.lights.size()); ++light) {
    if (samples_ == 1 || !can_be_hit(scene_.lights[light])) {
      result += sent_of(light, view, side, work);
      continue;
    }
    const EvenPoints places(static_cast<uint32_t>(samples_), work.rng);
    Rgb sum(0.0f);
    for (uint32_t i = 0; i < static_cast<uint32_t>(samples_); ++i) {
      const uint64_t place = places[i];
      work.rng.lead({&place, 1});
      sum += sent_of(light, view, side, work);
      work.rng.lead({});
    }
    result += sum / static_cast<float>(samples_);
  }
  return result;
}

DirectSample SurfaceShadowRays::from_even_sky(int light, const Rgb& radiance, const Vec3& shading_normal,
                                              const Receiver& side, const ShadowRays& rays) const {
  const Vec3 normal = glm::dot(shading_normal, side.normal) < 0.0f ? -shading_normal : shading_normal;
  const Vec3 direction = cosine_hemisphere(normal, rays.rng.uniform2());
  const float pdf = glm::dot(normal, direction) / kPi;
  if (!(pdf > 0.0f) || !(glm::dot(side.normal, direction) > 0.0f)) return {};
  return {direction, radiance / pdf * visibility(rays, {side.point, direction}, kInfinity, light, side.medium), pdf};
}

Rgb SurfaceShadowRays::sent_of(int light, const SurfaceView& view, const Receiver& side, EyeWork& work) const {
  count(work.counters.shadow_rays);
  const ShadowRays rays{scene_, *transmittance_, work.rng, work.counters.walk};
  const std::optional<Rgb> even = even_radiance(scene_.lights[light]);
  const DirectSample sample =
      even ? from_even_sky(light, *even, view.hit.shading_normal, side, rays) : sample_direct(rays, light, side);
  if (is_black(sample.irradiance)) return Rgb(0.0f);
  const ScatterValue scattered = scatter_value(view.material, view.hit, view.travel, sample.direction);
  return scattered.value * scattered.radiance_scale * sample.irradiance;
}

}  // namespace vpm
