// Phase functions by their Legendre moments, as plane-parallel transport needs them.
#pragma once

#include <vector>

namespace vpm::exact {

/// chi_l = int p(cos) P_l(cos) dOmega for l = 0, 1, ...: chi_0 = 1, chi_1 is the mean cosine. Further moments are 0.
using PhaseMoments = std::vector<double>;

PhaseMoments isotropic_moments();
/// chi_l = g^l [Henyey1941], as far as they count; |g| <= 0.9999 (more would be millions).
PhaseMoments henyey_greenstein_moments(double g);
/// 3 (1 + cos^2) / (16 pi).
PhaseMoments rayleigh_moments();

}  // namespace vpm::exact
