// Direct light on surfaces: a shadow ray to every light.
#pragma once

#include <memory>

#include "vpm/estimate/surface/estimator.h"
#include "vpm/path/direct_light.h"

namespace vpm {

class SurfaceShadowRays {
 public:
  SurfaceShadowRays(const Scene& scene, std::shared_ptr<const TransmittanceEstimator> transmittance)
      : scene_(scene), transmittance_(std::move(transmittance)) {}

  /// What the surface sends on of the light that comes straight from lights, W/(m^2 sr).
  Rgb sent(const SurfaceView& view, EyeWork& work) const;

 private:
  Rgb sent(const SurfaceView& view, const Receiver& side, EyeWork& work) const;

  const Scene& scene_;
  std::shared_ptr<const TransmittanceEstimator> transmittance_;
};

}  // namespace vpm
