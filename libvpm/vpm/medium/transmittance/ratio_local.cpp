// `ratio-local`: ratio tracking under the largest density of each brick of the grid on the way: empty bricks cost
// nothing, and one dense voxel makes look-ups dear in its own brick only [Novak2014].
//
// Known failure: that of `ratio`, and more of its noise: a majorant closer to the density has fewer look-ups, each of
// which decides more.
#include "vpm/medium/transmittance/brick_tracking.h"

namespace vpm {

TransmittanceEstimate LocalRatioTransmittance::estimate(const Medium& medium, const Ray& ray, const Interval& interval,
                                                        Rng& rng) const {
  return track_bricks(medium, ray, interval, rng, [](const DensityStretch& stretch) {
    return BrickSplit{0.0, stretch.max};
  });
}

}  // namespace vpm
