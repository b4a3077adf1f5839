// `decomposition`: the extinction in each brick is the sum of a control part, its least density, whose collisions need
// no look-up, and a residual that is tracked through null collisions [Kutz2017].
//
// The paper draws a distance for each part and takes the nearer one. Two Poisson processes are one, whose points are of
// either kind with the shares of their rates: here one distance is drawn at the rate of both, the brick's largest
// density, and one number tells whether its end is a collision of the control, a real one of the residual, or null.
//
// Known failure: where a brick's least density is far below the others it is `delta-local`; and who needs the density
// at the collision makes up for the look-up saved.
#include "vpm/medium/distance/null_collisions.h"
#include "vpm/medium/distance/strategies.h"

namespace vpm {

Flight Decomposition::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                             Rng& rng) const {
  return track_bricks(
      medium, ray, interval, NullCollisionFlight(medium, interval, power, rng), [](float max) { return max; },
      [&](NullCollisionFlight& flight, double t, const DensityStretch& stretch, double majorant) {
        if (!flight.is_real(stretch.min / majorant)) return flight.meet(t, stretch, majorant);
        if (needs_density_) flight.count_lookup();
        flight.collide(t, needs_density_ ? stretch.density(t) : stretch.min);
        return true;
      });
}

}  // namespace vpm
