// The radiance of black bodies in the three channels of linear sRGB.
#pragma once

#include "vpm/base/vec.h"

namespace vpm {

/// Below this a black body is dark, K: its luminance is 1e-15 cd/m^2 at 400 K.
inline constexpr double kColdestSeen = 400.0;

/// The CIE 1931 tristimulus values of a black body, W/(m^2 sr): its radiance by wavelength, weighted by the colour
/// matching functions of the 2 degree observer, as a sum over 360 to 830 nm, every 5 nm [CIE2018]. Y times 683.002 is
/// the luminance, cd/m^2. `kelvin` > 0.
Vec3d blackbody_xyz(double kelvin);

/// Linear sRGB of the same unit, [IEC1999]'s primaries.
inline Rgbd linear_srgb_of_xyz(const Vec3d& xyz) {
  return {3.2409699419045235 * xyz.x - 1.5373831775700944 * xyz.y - 0.49861076029300355 * xyz.z,
          -0.96924363628087983 * xyz.x + 1.8759675015077202 * xyz.y + 0.041555057407175590 * xyz.z,
          0.055630079696993650 * xyz.x - 0.20397695888897649 * xyz.y + 1.0569715142428786 * xyz.z};
}

/// The radiance of a black body, W/(m^2 sr), up to 1e8 K to 1e-6 of the sum above. Colours outside sRGB are clamped:
/// blue below 1900 K and green below 964 K are 0, by which luminance rises by 0.65 % at 1000 K. 0 up to kColdestSeen.
Rgbd blackbody(double kelvin);

}  // namespace vpm
