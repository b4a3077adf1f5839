// Light of an isotropic point source, or of a collimated beam, that a homogeneous medium scatters once into a ray of
// sight.
#pragma once

#include "vpm/study/exact/quadrature.h"

namespace vpm::exact {

/// Camera at t = 0 of the ray, inside an infinite medium; the medium scatters between t0 and t1 only.
struct Airlight {
  double sigma_t = 1.0;   // 1/m
  double albedo = 1.0;    // in [0, 1]
  double g = 0.0;         // of Henyey and Greenstein's phase function, in (-1, 1)
  double distance = 1.0;  // of the source from the ray, m, > 0
  double closest = 0.0;   // t where the ray passes the source, m
  double t0 = 0.0;        // m, >= 0
  double t1 = 1.0;        // m, > t0, may be infinite
};

struct AirlightSolution {
  Bounded radiance;             // W/(m^2 sr) for a source of 1 W/sr; a source of power P has P / (4 pi)
  double log10_radiance = 0.0;  // also where the radiance underflows
};

AirlightSolution solve_airlight(const Airlight& airlight);

/// A beam of light of an irradiance of 1 W/m^2 across it, in an infinite medium. A ray of sight meets its axis.
struct BeamAirlight {
  double sigma_t = 1.0;      // 1/m
  double albedo = 1.0;       // in [0, 1]
  double g = 0.0;            // of Henyey and Greenstein's phase function, in (-1, 1)
  double beam_radius = 1.0;  // m
  double cosine = 0.0;       // between the directions in which light and the ray of sight travel, in (-1, 1)
  double flown = 1.0;        // m, from the light along the axis to where the ray meets it
  double seen = 1.0;         // m, from the eye to there: both so long that light and eye are outside of what is seen
};

/// The radiance, W/(m^2 sr), in closed form.
Bounded solve_beam_airlight(const BeamAirlight& airlight);

}  // namespace vpm::exact
