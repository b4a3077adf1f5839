// Pictures that theory knows, as references without noise.
#pragma once

#include "vpm/image/image.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// The picture of a ball of homogeneous fog that scatters isotropically, alone in vacuum in an environment of the same
/// radiance everywhere, seen from outside: all orders of scattering, by exact::solve_sphere(), over each pixel's
/// filter. W/(m^2 sr), right to 1e-4 of the environment's radiance, in pixels that the rim of the ball crosses to 2e-3.
/// Throws InputError for any other scene, with what differs.
Image exact_picture(const Scene& scene);

}  // namespace vpm
