// Media that emit, in slabs, balls and closed cavities, and what paths see of them.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/base/statistics/moments.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// A slab from z = 0 to `thickness`, m, ten thousand times as wide as it is thick; around it the environment has that
/// radiance, if any.
Scene glowing_slab(const Medium& medium, double thickness, const Rgb& around = Rgb(0.0f));
/// A ball. Where `reflectance` is above 0 there is a wide diffuse floor at y = 0, too.
Scene glowing_ball(const Medium& medium, const SphereShape& ball, float reflectance = 0.0f);
/// A medium with a grid, in the grid's box, over such a floor.
Scene glowing_grid(const Medium& medium, float reflectance);
/// A cube of 2 m about the origin, filled by the medium; its walls reflect diffusely and send out `emitted`, W/(m^2
/// sr).
Scene furnace(const Medium& medium, float reflectance, const Rgb& emitted);

/// What paths find along rays that start in medium number `start`. A sample is a path along each ray; the result has
/// the three channels of the first ray, then those of the second ...
std::vector<Moments> seen_by_paths(const Scene& scene, MediumId start, const std::vector<Ray>& rays, uint64_t samples,
                                   uint64_t seed);

}  // namespace vpm
