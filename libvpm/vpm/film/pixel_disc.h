// Radii of stochastic progressive photon mapping: each pixel has its own, which depends on the photons it has found.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "vpm/estimate/radius_schedule.h"

namespace vpm {

/// What a pixel keeps from pass to pass of the disc over which it gathers the photons of surfaces [Hachisuka2009]. It
/// is what a point keeps in [Hachisuka2008], shared by all points that the pixel sees. The third number of the method,
/// the flux tau, is left to the film: tau / R^2 is the sum over passes of what each pass found, divided by the square
/// of the radius it had. So the mean of passes says the same.
struct PixelDisc {
  double area = 1.0;     // R^2 of the next pass over that of the first
  double photons = 0.0;  // N: photons found, less those that shrinking has left outside
};
/// The discs of the pixels, row by row; none before the first pass, and where pixels have no radii of their own.
using PixelDiscs = std::vector<PixelDisc>;

/// Shrinks the disc after a pass that has found so many photons, M: N' = N + alpha M, R'^2 = R^2 N' / (N + M)
/// [Hachisuka2009]. Under uniform light, R^2 shrinks by (i + alpha) / (i + 1) after pass number i, counted from 0.
/// These are the factors of measure_of_pass(), after a first factor of alpha. So alpha is its A.
///
/// M is a sum over the pixel's samples. Their mean would do as well, because the rule depends only on the ratio of M
/// and N.
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
