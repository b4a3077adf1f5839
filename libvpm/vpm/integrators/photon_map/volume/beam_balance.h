// Photon beams that cross a ray, collisions beside it and photon planes find the same light. The balance heuristic
// [Veach1997, sec. 9.2] combines them: beams that run nearly along the ray are bright without bound, as they are
// divided by the sine of the angle between the two; so are planes that the ray lies in; collisions are rare where the
// medium is thin.
#pragma once

namespace vpm {

/// The shares of the light that is scattered at a place of the ray, having arrived there in some direction. Per photon,
/// a beam comes within the kernel with a probability as 1D kernel x sine, a collision as sigma_t x 2D kernel
/// [Krivanek2014]: these two share light, and their shares sum to 1. The size of a kernel is that of a constant one of
/// the same variance. Long beams are weighed as short ones: their shares sum to 1 as well.
///
/// A Real is a float, or Floats of many rays.
///
/// Beside planes, light whose last flight began at a collision is shared by beams and planes instead. Per photon, a
/// beam then needs a collision at that place, with a probability as sigma_s, and a plane crosses the ray with one as
/// the determinant [Bitterli2017].
struct BeamBalance {
  float line = 0.0f;   // m: the size of the beams' kernel, times the share of the flights that are kept as beams
  float disc = 0.0f;   // m^2: the size of the collisions' kernel
  float plane = 0.0f;  // the share of the flights that are kept as planes

  /// The share of beams over the sine (> 0) between the directions of light and ray: bounded where sigma_t, 1/m, that
  /// of the place on the ray, is above 0.
  template <class Real>
  Real of_beams_over_sine(const Real& sine, float sigma_t) const {
    return line / (line * sine + disc * sigma_t);
  }
  /// The share of collisions.
  template <class Real>
  Real of_collisions(const Real& sine, float sigma_t) const {
    return sigma_t > 0.0f ? disc * sigma_t / (line * sine + disc * sigma_t) : Real{};
  }
  /// The share of beams over the sine, beside planes, for the scattering coefficient where the flight began, 1/m, and
  /// the volume that its direction, the one before and the ray's span: bounded unless both sine and volume are near 0.
  template <class Real>
  Real of_beams_beside_planes_over_sine(const Real& sine, float sigma_s, const Real& determinant) const {
    return line * sigma_s / (line * sine * sigma_s + plane * determinant);
  }
  /// The share of planes over the determinant (> 0), likewise.
  float of_planes_over_determinant(float sine, float sigma_s, float determinant) const {
    return plane / (line * sine * sigma_s + plane * determinant);
  }
};

}  // namespace vpm
