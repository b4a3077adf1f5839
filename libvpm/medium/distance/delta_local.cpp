// `delta-local`: tracking through null collisions under the largest density of each brick on the way
// [SzirmayKalos2011]. Empty bricks cost nothing.
//
// Known failure: where densities differ much within a brick of 8^3 cells most collisions are null still.
#include "medium/distance/null_collisions.h"
#include "medium/distance/strategies.h"

namespace vpm {

Flight DeltaLocal::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                          Rng& rng) const {
  NullCollisionFlight flight(medium, interval, power, rng);
  const uint32_t bricks = medium.visit_majorants(ray, interval, [&](const DensityStretch& stretch) {
    for (double t = stretch.t0; flight.advance(t, stretch.t1, stretch.max);)
      if (flight.meet(t, stretch.density(t), stretch.max)) return false;
    return true;
  });
  flight.count_bricks(bricks);
  return flight.result();
}

}  // namespace vpm
