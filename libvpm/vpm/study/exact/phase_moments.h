// Phase functions by their Legendre moments, as plane-parallel transport needs them.
#pragma once

#include <vector>

#include "vpm/medium/phase/phase.h"

namespace vpm::exact {

/// chi_l = int p(cos) P_l(cos) dOmega for l = 0, 1, ...: chi_0 = 1, chi_1 is the mean cosine. Further moments are 0.
using PhaseMoments = std::vector<double>;

PhaseMoments isotropic_moments();
/// chi_l = g^l [Henyey1941], as far as they count; |g| <= 0.9999 (more would be millions).
PhaseMoments henyey_greenstein_moments(double g);
/// 3 (1 + cos^2) / (16 pi).
PhaseMoments rayleigh_moments();
/// Henyey and Greenstein's function times 1 + alpha cos^2 [Draine2003], as far as they count; |g| <= 0.9999.
PhaseMoments draine_moments(double g, double alpha);
/// Of two phase functions, the first with the share `first`.
PhaseMoments mixed_moments(const PhaseMoments& a, const PhaseMoments& b, double first);
/// Up to the order from which on they are below 1e-8, 2000 at the most.
PhaseMoments table_moments(const PhaseTable& table);
/// Of a medium's phase function, whose lobes have |g| <= 0.9999.
PhaseMoments moments_of(const Phase& phase);

// Phase functions with forward peaks too narrow for a number of ordinates: what is cut off passes for unscattered
// light, and comes back where light that scattered once is seen.

/// A slab without the peak: its optical depths are `depth_scale` times the true ones [Wiscombe1977].
struct TruncatedSlab {
  double depth_scale = 1.0;
  double albedo = 1.0;
  PhaseMoments phase;
  PhaseMoments missing;  // added to `phase`: the true one, in its new normalisation
};

/// Keeps `orders` moments.
TruncatedSlab truncate_forward_peak(double albedo, const PhaseMoments& phase, int orders);

/// What `truncated` lacks in the radiance that a beam along the normal, of irradiance 1, makes by scattering once: back
/// at depth 0 (cosine < 0) or out at `tau` (cosine > 0), the cosine to the beam; `tau` is the truncated one
/// [Nakajima1988].
double missing_single_scattering(const TruncatedSlab& truncated, double tau, double cosine);

}  // namespace vpm::exact
