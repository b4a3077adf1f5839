// Plane-parallel slabs and half spaces: how much light they reflect and transmit, in which directions, and the fluence
// inside. All orders of scattering; index matched, dark surroundings, one albedo and phase function throughout.
//
// Depth is optical depth. A slab whose extinction varies with depth z is this problem at tau(z) [Chandrasekhar1960].
#pragma once

#include <vector>

#include "vpm/study/exact/phase_moments.h"
#include "vpm/study/exact/quadrature.h"

namespace vpm::exact {

/// How light falls on the surface at depth 0, with irradiance 1: along the inward normal, or as radiance 1/pi from
/// everywhere.
enum class Incidence { collimated_normal, diffuse };

struct Slab {
  double tau = 1.0;     // optical thickness; infinite for a half space
  double albedo = 1.0;  // in [0, 1]
  PhaseMoments phase = {1.0};
  Incidence incidence = Incidence::collimated_normal;
};

/// Where a solution is wanted.
struct SlabPlaces {
  std::vector<double> depths;    // in [0, tau], optical
  std::vector<double> mus;       // cosines in (0, 1] to the outward normal, for radiance
  std::vector<double> mu_edges;  // ascending in [0, 1]: bins of these cosines, for flux
};

/// Per unit of incident irradiance.
struct SlabSolution {
  Bounded reflected, transmitted, absorbed;        // fractions; `transmitted` includes `unscattered`
  double unscattered = 0.0;                        // fraction transmitted without a collision
  BoundedSeries fluence;                           // at depths; includes the uncollided
  std::vector<double> uncollided_fluence;          // at depths
  BoundedSeries net_flux;                          // at depths: downwards less upwards
  BoundedSeries reflected_radiance;                // at mus, 1/sr
  BoundedSeries transmitted_radiance;              // at mus, scattered light only, 1/sr
  BoundedSeries reflected_flux, transmitted_flux;  // in the bins between mu_edges, scattered light only
};

/// Solved twice, with different numbers of ordinates; errors are four times the difference, and an allowance for
/// rounding.
SlabSolution solve_slab(const Slab& slab, const SlabPlaces& places = {});

/// Chandrasekhar's H function of isotropic scattering, albedo and mu in [0, 1]: a half space lit along the normal
/// reflects 1 - sqrt(1 - albedo) H(1) of the light [Chandrasekhar1960].
Bounded chandrasekhar_h(double albedo, double mu);

}  // namespace vpm::exact
