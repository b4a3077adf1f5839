// How densely photons are emitted: what techniques that might have found the same path are weighed by.
#pragma once

#include "vpm/light/light.h"

namespace vpm {

/// The densities of emit(), for one light.
struct EmissionDensity {
  double place = 0.0;   // of the point on the light, 1/m^2; of a light at infinity that of the direction, 1/sr; 1 where
                        // there is only one
  double flight = 0.0;  // of the direction from there, 1/sr; of parallel light that of the place across it, 1/m^2
  bool parallel = false;  // does light not spread from its point?
};

/// The densities with which emit() starts photons that travel along `travel` (unit), from a point of the light with the
/// outward normal `normal` (unit, without meaning for lights that have none). `scene` is the box that emit() is given.
EmissionDensity emission_density(const Light& light, const Box& scene, const Vec3& normal, const Vec3& travel);
/// Of a medium that emits, from anywhere on a line over which all that it emits is `arriving`, W/(m^2 sr), at a place
/// beyond: how densely photons fly by there, on their first flight. `place` is 1/sr, as of parallel light.
EmissionDensity emission_density(const Light& medium, const Rgb& arriving);

/// The density of sample_towards() from a point at `place`, in the measure of EmissionDensity::place.
double sampled_density(const Light& light, const Vec3& place, const SeenLight& seen);
/// Can a path run into the light by chance?
bool can_be_hit(const Light& light);

}  // namespace vpm
