// The eye's side of photon mapping: the radiance along one camera ray.
#pragma once

#include "vpm/render/plan.h"

namespace vpm {

/// What eye paths read. Immutable while rays run.
struct EyeContext {
  const Scene& scene;
  const Estimators& estimators;
  int max_events = 100'000;  // of one path; those cut are counted
};

/// Follows a camera ray: through boundaries and specular surfaces; each segment adds what its medium scatters towards
/// the eye, as the estimators of volumes say; the first rough surface adds what that of surfaces says, and ends the
/// path. W/(m^2 sr).
Rgb eye_radiance(const EyeContext& context, const Ray& camera_ray, EyeWork& work);

}  // namespace vpm
