// Light that a medium sends out by itself, to all sides alike.
#pragma once

#include "vpm/base/vec.h"

namespace vpm {

struct Medium;

/// What a medium emits: its source, a colour times the value of a grid, or a black body of the temperature there; 0
/// where the grid is 0.
///
/// Thermal: the source is the radiance of a thick layer, W/(m^2 sr), and the emission coefficient is sigma_a times
/// density times that: no absorption, no emission. By volume: the source is the emission coefficient itself, W/(m^3
/// sr), whatever the density; 4 pi times it is the power of a volume, W/m^3.
struct MediumEmission {
  enum class Meaning { thermal, volume };
  Meaning meaning = Meaning::thermal;
  Rgb colour{0.0f};                  // what the source is multiplied by; see above
  bool blackbody = false;            // by temperature
  double scale = 1.0, offset = 0.0;  // K: the temperature is the offset plus scale times the grid's value, if any

  double kelvin(double value) const { return offset + scale * value; }
  /// The source where the grid has that value; it does not fall where that rises.
  Rgbd source(double value) const;
};

/// Temperatures that fires reach, K: others are likely to be no kelvin.
inline constexpr double kColdestFire = 700.0, kHottestFire = 20'000.0;

/// The emission coefficient of a medium that emits, at a place of the world, W/(m^3 sr).
Rgbd emission_coefficient(const Medium& medium, const Vec3& place);

/// What arrives at a ray's origin of what a medium emits along a part of it, W/(m^2 sr), attenuated from the interval's
/// start on; and the density integral of that part, m.
struct EmittedLight {
  Rgb radiance{0.0f};
  double integral = 0.0;
};
/// The integral of emission coefficient times transmittance. Exact where the source is even, or nothing attenuates;
/// else by Gauss's five points in pieces of an optical depth of at most 1 in which the temperature changes by at most
/// 15 %, to about 1e-4 of the largest source in a piece, usually far less. What lies behind an optical depth of 25, in
/// all channels, is left out. `medium` emits; adds the look-ups of densities and sources.
EmittedLight emitted_along(const Medium& medium, const Ray& ray, const Interval& interval, uint64_t& lookups);

}  // namespace vpm
