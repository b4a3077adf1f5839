// Radiative transport in a plane layer by discrete ordinates: the angular modes of the equation, and the sum of them
// that fits what enters the layer [Stamnes1988]. Lengths are optical depths; radiance is symmetric about the normal.
//
// mu dI/dtau = -I + (albedo / 2) sum_l (2l+1) chi_l P_l(mu) int_{-1}^1 P_l I dmu' [Chandrasekhar1960], with the
// integral by a rule over each hemisphere. For J = I(mu) + I(-mu) and H = I(mu) - I(-mu), mu > 0 pointing downwards, it
// decouples into M dH/dtau = -A J and M dJ/dtau = -B H, whose modes J = x f(tau), H = -y f'(tau) have f'' = k^2 f.
#pragma once

#include <vector>

#include "vpm/study/exact/phase_moments.h"

namespace vpm::exact {

/// Directions mu in (0, 1] of a hemisphere, with weights of int_0^1 dmu. The last one is the normal.
struct Ordinates {
  std::vector<double> mu, weight;
};
/// `count` of them, gathered where radiance varies most: at the horizon, where it has terms like mu^n log(mu).
Ordinates make_ordinates(int count);

/// The modes of a medium; matrices are stored column after column, a column per mode.
struct Modes {
  Ordinates ordinates;
  double albedo = 0.0;
  std::vector<double> k;        // decay per optical depth; 0 for the last mode of a medium without absorption
  std::vector<double> x, y;     // J and H at the ordinates
  std::vector<double> moments;  // of each mode: (2l+1) chi_l sum w P_l x for even l, with y for odd l
  int orders = 0;               // rows of `moments`
};
Modes make_modes(double albedo, const PhaseMoments& phase, const Ordinates& ordinates);

/// The radiance in a layer [0, tau]: J = sum_m x_m (even_m e_m + odd_m o_m) with shapes even and odd about the middle,
/// e = cosh(k (t - tau/2)) / cosh(k tau/2) and o = sinh(k (t - tau/2)) / sinh(k tau/2).
struct LayerField {
  const Modes* modes = nullptr;
  double tau = 0.0;
  std::vector<double> even, odd;
};
/// `incoming`: radiance entering at depth 0, at the ordinates; nothing enters at `tau`. With tau infinite, a half
/// space.
LayerField illuminate(const Modes& modes, double tau, const std::vector<double>& incoming);
/// The same with `incoming` at `tau`, and its negative at depth 0.
LayerField illuminate_antisymmetric(const Modes& modes, double tau, const std::vector<double>& incoming);

/// int_{4 pi} L dOmega at depth t.
double fluence(const LayerField& field, double t);
/// Power through a surface of depth t per area: downwards less upwards.
double net_flux(const LayerField& field, double t);
/// Radiance of light that leaves at depth 0 or at tau after scattering, at mu > 0 to the outward normal.
double exit_radiance_top(const LayerField& field, double mu);
double exit_radiance_bottom(const LayerField& field, double mu);

/// int_{4 pi} L dOmega of each mode, before its coefficient and shape.
std::vector<double> mode_fluence(const Modes& modes);

}  // namespace vpm::exact
