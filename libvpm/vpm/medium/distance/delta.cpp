// `delta`: tracking through null collisions under one majorant, the medium's largest density [Woodcock1965].
//
// Known failure: a few dense voxels in a thin medium make nearly all collisions null, at a look-up each.
#include "vpm/medium/distance/null_collisions.h"
#include "vpm/medium/distance/strategies.h"
#include "vpm/medium/majorant_of_lookups.h"

namespace vpm {

Flight Delta::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power, Rng& rng) const {
  const Interval inside = medium.clip(ray, interval);
  const double majorant = majorant_of_lookups(medium);
  const DensityAlong along = medium.density_along(ray);
  NullCollisionFlight flight(medium, interval, power, rng);
  for (double t = inside.t0; flight.advance(t, inside.t1, majorant);)
    if (flight.meet(t, along.at(t), majorant)) break;
  return flight.result(0);
}

}  // namespace vpm
