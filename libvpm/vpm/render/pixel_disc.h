// Radii of stochastic progressive photon mapping: each pixel's own, by the photons that it has found.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "vpm/estimate/radius_schedule.h"

namespace vpm {

/// What a pixel carries from pass to pass of the disc that it gathers photons of surfaces over [Hachisuka2009]: that of
/// a point in [Hachisuka2008], shared by all points that the pixel sees. The third number of the method, the flux tau,
/// is left to the film: tau / R^2 is the sum over passes of what each found, over the square of the radius it had, so
/// that the mean of passes says the same.
struct PixelDisc {
  double area = 1.0;     // R^2 of the next pass over that of the first
  double photons = 0.0;  // N: those found, less those that shrinking has left outside
};
/// By pixel, row by row; none before the first pass, and where radii are not the pixels' own.
using PixelDiscs = std::vector<PixelDisc>;

/// Shrinks the disc after a pass that has found so many photons, M: N' = N + alpha M, R'^2 = R^2 N' / (N + M)
/// [Hachisuka2009]. In even light R^2 shrinks by (i + alpha) / (i + 1) after pass number i, from 0: the factors of
/// measure_of_pass() after a first one, alpha. So alpha is A.
///
/// M is a sum over the pixel's samples. Their mean would do as well: the rule knows M and N by their ratio alone.
inline void shrink(PixelDisc& disc, uint64_t found) {
  if (found == 0) return;
  const double all = disc.photons + static_cast<double>(found);
  const double kept = disc.photons + best_a(2) * static_cast<double>(found);
  disc.area *= kept / all;
  disc.photons = kept;
}

/// The radius of the next pass, m, for that of the first.
inline float disc_radius(const PixelDisc& disc, float first) {
  return static_cast<float>(first * std::sqrt(disc.area));
}

}  // namespace vpm
