// `residual-ratio`: residual ratio tracking. The extinction is a control, whose transmittance is known, and a residual,
// which is left to ratio tracking: each look-up leaves the share 1 - residual / (largest residual) [Novak2014].
//
// The control is the middle of the density's bounds in each brick of the grid: of all constants it has the least
// largest residual, half of what the bounds are apart, and needs half the look-ups of `ratio-local` where the least
// density is 0. The relative variance is exp(int residual^2 / largest residual) - 1, no more than exp() of the mean
// number of look-ups. Residuals of either sign: look-ups leave shares from 0 to 2, and values above 1 are legal.
//
// Known failure: a brick that is empty except for a small part. Its residual is nearly maximal almost everywhere;
// ratio tracking, whose look-ups leave the light alone there, is better in such bricks.
#include "vpm/medium/transmittance/brick_tracking.h"

namespace vpm {

TransmittanceEstimate ResidualRatioTransmittance::estimate(const Medium& medium, const Ray& ray,
                                                           const Interval& interval, Rng& rng) const {
  return track_bricks(medium, ray, interval, rng, [](const DensityStretch& stretch) {
    return BrickSplit{0.5 * (double{stretch.max} + stretch.min), 0.5 * (double{stretch.max} - stretch.min)};
  });
}

}  // namespace vpm
