// The eye's side of photon mapping: the radiance along one camera ray, gathered from the photon maps.
#pragma once

#include <vector>

#include "estimate/photon_map.h"
#include "render/march.h"
#include "render/photon_pass.h"

namespace vpm {

/// What the eye pass reads: one pass's maps and methods. Immutable while rays run.
struct EyeContext {
  const Scene& scene;
  const RenderSettings& settings;
  Stages stages;
  std::vector<PhotonMap> volume;  // by medium; empty without a volume map
  PhotonMap surface;
  std::unique_ptr<TransmittanceEstimator> transmittance;
};

/// Follows a camera ray: through boundaries and specular surfaces; media add the ray-marched volumetric radiance
/// estimate [Jarosz2008, eq. 7.9]; the first rough surface adds direct light and the surface radiance estimate and
/// ends the path. W/(m^2 sr).
Rgb eye_radiance(const EyeContext& context, const Ray& camera_ray, Marcher& marcher, Rng& rng, EyeCounters& counters);

}  // namespace vpm
