#include "vpm/study/exact/phase_moments.h"

#include <cassert>
#include <cmath>

namespace vpm::exact {

PhaseMoments isotropic_moments() { return {1.0}; }

PhaseMoments henyey_greenstein_moments(double g) {
  assert(std::fabs(g) <= 0.9999);
  PhaseMoments moments;
  for (double chi = 1.0; std::fabs(chi) > 1e-16; chi *= g) moments.push_back(chi);
  return moments;
}

PhaseMoments rayleigh_moments() { return {1.0, 0.0, 0.1}; }

}  // namespace vpm::exact
