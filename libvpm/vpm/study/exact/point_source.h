// An isotropic point source of 1 W in an infinite homogeneous medium: fluence around it. All orders of scattering.
//
// Lengths are optical radii r = sigma_t times distance, and sigma_t is 1/m: elsewhere fluence(distance) = sigma_t^2
// phi(r).
#pragma once

#include <vector>

#include "vpm/study/exact/phase_moments.h"
#include "vpm/study/exact/quadrature.h"

namespace vpm::exact {

struct PointSourceSolution {
  std::vector<double> uncollided;   // fluence exp(-r) / (4 pi r^2), W/m^2
  std::vector<Bounded> collided;    // fluence of light that has scattered, W/m^2
  std::vector<Bounded> collisions;  // per emitted photon within r, the last (absorbing) one included
};

/// At each of `radii` > 0, albedo in [0, 1]: by Case's formula where scattering is isotropic, else by P_N.
PointSourceSolution solve_point_source(double albedo, const PhaseMoments& phase, const std::vector<double>& radii);

/// The two methods.
PointSourceSolution point_source_case(double albedo, const std::vector<double>& radii);
PointSourceSolution point_source_pn(double albedo, const PhaseMoments& phase, const std::vector<double>& radii);

}  // namespace vpm::exact
