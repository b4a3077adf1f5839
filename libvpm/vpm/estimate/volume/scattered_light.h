// Light that a point of a medium receives straight from a light and scatters towards the eye.
#pragma once

#include <memory>
#include <optional>

#include "vpm/estimate/eye_segment.h"
#include "vpm/path/direct_light.h"

namespace vpm {

/// A light, and a point of it where one is drawn beforehand.
struct LightSource {
  PickedLight picked;
  std::optional<LightPoint> from;
};

/// Single scattering at points, by one shadow ray each.
class ScatteredOnce {
 public:
  ScatteredOnce(const Scene& scene, std::shared_ptr<const TransmittanceEstimator> transmittance)
      : scene_(scene), transmittance_(std::move(transmittance)) {}

  /// Picks a light by power, and draws a point of it where it has points.
  LightSource draw(Rng& rng) const;
  /// Picks a light by power.
  LightSource pick(Rng& rng) const { return {pick_light(scene_, rng.uniform_double()), {}}; }
  /// What the light sends to a point of the segment, scattered there towards the eye: irradiance times phase function
  /// over the probability to pick that light, W/(m^2 sr).
  Rgb towards_eye(const LightSource& light, const EyeSegment& segment, const Vec3& point, EyeWork& work) const;

 private:
  const Scene& scene_;
  std::shared_ptr<const TransmittanceEstimator> transmittance_;
};

}  // namespace vpm
