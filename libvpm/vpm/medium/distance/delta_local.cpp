// `delta-local`: tracking through null collisions under the largest density of each brick on the way
// [SzirmayKalos2011]. Empty bricks cost nothing. Without a grid no collision is null, and none is drawn to be.
//
// Known failure: where densities differ much within a brick of 8^3 cells most collisions are null still.
#include "vpm/medium/distance/null_collisions.h"
#include "vpm/medium/distance/strategies.h"

namespace vpm {

Flight DeltaLocal::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                          Rng& rng) const {
  if (medium.homogeneous()) return Homogeneous().sample(medium, ray, interval, power, rng);
  return track_bricks(
      medium, ray, interval, NullCollisionFlight(medium, interval, power, rng), [](float max) { return max; },
      [](NullCollisionFlight& flight, double t, const DensityStretch& stretch, double majorant) {
        return flight.meet(t, stretch, majorant);
      });
}

}  // namespace vpm
