// What a pass takes and the error that it leaves, as functions of its photons and of the radii that they are gathered
// within. A pilot measures the coefficients.
#pragma once

#include "vpm/base/statistics/line_fit.h"
#include "vpm/integrators/settings.h"

namespace vpm {

/// A picture's squared bias goes as the fourth power of the radius where light is smooth, and as the first or second at
/// edges: a middle.
inline constexpr double kPowerOfBias = 3.0;

/// Radii are factors of those that a pilot began with.
struct PassModel {
  Line making;                  // s, of photons
  Line seeing;                  // s, of photons times the area that they are gathered in
  Line noise;                   // relative variance of a pass, of 1 / photons, and 1 / radii to the power of noise
  double bias2 = 0.0;           // the squared bias by the kernels' corrections
  double power_of_noise = 0.0;  // see IntegratorInfo
  double unseen = 0.0;          // relative variance of a pass, by light that others show for certain, and this does not

  /// s: a pass.
  double seconds(double photons, double radii) const { return making(photons) + seeing(radii * radii * photons); }
  /// The relative MSE of so many passes, >= 1. The noise of rays falls as one over them. That of photons and the bias
  /// go as radii do: all are taken to shrink as those of discs.
  double error(double passes, double photons, double radii, const RenderSettings& settings) const;
};

}  // namespace vpm
