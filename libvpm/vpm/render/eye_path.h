// The eye's side of photon mapping: the radiance along one camera ray, gathered from the photon maps.
#pragma once

#include "vpm/render/eye_context.h"
#include "vpm/render/march.h"
#include "vpm/render/surface_light.h"

namespace vpm {

/// Follows a camera ray: through boundaries and specular surfaces; media add the ray-marched volumetric radiance
/// estimate [Jarosz2008, eq. 7.9]; the first rough surface adds what it sends (surface_light()) and ends the path.
/// W/(m^2 sr). `own`, under Stages::pixel_discs, is how the ray's pixel gathers on that surface.
Rgb eye_radiance(const EyeContext& context, const Ray& camera_ray, Marcher& marcher, Rng& rng, EyeCounters& counters,
                 const PixelGather* own = nullptr);

}  // namespace vpm
