// A homogeneous sphere that scatters isotropically, in a uniform environment of radiance 1: what leaves it, the fluence
// inside, and its image. All orders of scattering; index matched.
#pragma once

#include <vector>

#include "vpm/study/exact/quadrature.h"

namespace vpm::exact {

struct SphereSolution {
  Bounded escaping, absorbed;  // fractions of the power that enters
  double uncollided = 0.0;     // fraction that crosses without a collision
  BoundedSeries fluence;       // per radiance of the environment, sr
  BoundedSeries image;         // radiance seen along rays, over the environment's
};

/// `optical_radius` > 0, albedo in [0, 1]. Fluence at `radii` and image at `impacts` (distances of rays from the
/// center), both over the sphere's radius, in [0, 1].
SphereSolution solve_sphere(double optical_radius, double albedo, const std::vector<double>& radii = {},
                            const std::vector<double>& impacts = {});

}  // namespace vpm::exact
