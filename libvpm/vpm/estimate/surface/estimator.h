// The open set of estimators of the light that non-specular surfaces send towards the eye: one file each, one virtual
// call for each surface that an eye ray ends on.
#pragma once

#include "vpm/estimate/estimator.h"
#include "vpm/estimate/eye_work.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// A non-specular surface as met by a path that travels along `travel` in `medium`.
struct SurfaceView {
  const Hit& hit;
  const Material& material;
  Vec3 travel{0.0f};  // unit
  MediumId medium = kVacuum;
};

class SurfaceEstimator : public Estimator {
 public:
  /// Estimates the radiance that leaves the surface in the direction -`travel`, W/(m^2 sr), without its own emission.
  virtual KernelEstimate sent(const SurfaceView& view, EyeWork& work) const = 0;
  /// The number of photons found in the disc of each pixel, over its samples; empty where pixels have no discs of their
  /// own.
  virtual std::vector<uint64_t> take_found() { return {}; }
};

}  // namespace vpm
