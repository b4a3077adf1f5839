// Direct light on surfaces: shadow rays to every light.
#pragma once

#include <memory>

#include "vpm/integrators/photon_map/estimator.h"
#include "vpm/path/direct_light.h"

namespace vpm {

class SurfaceShadowRays {
 public:
  /// Sends `samples` rays to each light that has an area or a solid angle, to places that lie evenly on it; one to
  /// others.
  SurfaceShadowRays(const Scene& scene, std::shared_ptr<const TransmittanceEstimator> transmittance, int samples)
      : scene_(scene), transmittance_(std::move(transmittance)), samples_(samples) {}

  /// What the surface sends on of the light that comes straight from lights, W/(m^2 sr).
  Rgb sent(const SurfaceView& view, EyeWork& work) const;

 private:
  Rgb sent(const SurfaceView& view, const Receiver& side, EyeWork& work) const;
  /// By a ray to a light of no place and no direction: as light comes to a surface, by the cosine law.
  DirectSample from_even_sky(int light, const Rgb& radiance, const Vec3& shading_normal, const Receiver& side,
                             const ShadowRays& rays) const;
  /// Of one light, by one ray.
  Rgb sent_of(int light, const SurfaceView& view, const Receiver& side, EyeWork& work) const;

  const Scene& scene_;
  std::shared_ptr<const TransmittanceEstimator> transmittance_;
  int samples_;
};

}  // namespace vpm
