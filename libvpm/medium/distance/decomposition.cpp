// `decomposition`: the extinction in each brick is the sum of a control part, its least density, whose collisions need
// no look-up, and a residual that is tracked through null collisions [Kutz2017].
//
// The paper draws a distance for each part and takes the nearer one. Two Poisson processes are one, whose points are of
// either kind with the shares of their rates: here one distance is drawn at the rate of both, the brick's largest
// density, and one number tells whether its end is a collision of the control, a real one of the residual, or null.
//
// Known failure: where a brick's least density is far below the others it is `delta-local`; and who needs the density
// at the collision makes up for the look-up saved.
#include "medium/distance/null_collisions.h"
#include "medium/distance/strategies.h"

namespace vpm {

Flight Decomposition::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                             Rng& rng) const {
  NullCollisionFlight flight(medium, interval, power, rng);
  const uint32_t bricks = medium.visit_majorants(ray, interval, [&](const DensityStretch& stretch) {
    const double control = static_cast<double>(stretch.min) / static_cast<double>(stretch.max);
    for (double t = stretch.t0; flight.advance(t, stretch.t1, stretch.max);) {
      if (flight.is_real(control)) {
        if (needs_density_) flight.count_lookup();
        flight.collide(t, needs_density_ ? stretch.density(t) : stretch.min);
        return false;
      }
      if (flight.meet(t, stretch.density(t), stretch.max)) return false;
    }
    return true;
  });
  flight.count_bricks(bricks);
  return flight.result();
}

}  // namespace vpm
