// `ratio-local`: ratio tracking under the largest density of each brick of the grid on the way: empty bricks cost
// nothing, and one dense voxel makes look-ups dear in its own brick only [Novak2014].
//
// Known failure: that of `ratio`, and more of its noise: a majorant closer to the density has fewer look-ups, each of
// which decides more.
#include "medium/transmittance/estimators.h"
#include "medium/transmittance/marched_columns.h"
#include "medium/transmittance/poisson_points.h"

namespace vpm {

TransmittanceEstimate LocalRatioTransmittance::estimate(const Medium& medium, const Ray& ray, const Interval& interval,
                                                        Rng& rng) const {
  const Interval inside = medium.clip(ray, interval);
  if (const auto known = known_transmittance(medium, inside)) return *known;
  const Rgbd sigma_t(medium.sigma_t);
  const double densest = max_channel(medium.sigma_t);
  uint32_t lookups = 0;
  Rgbd product(1.0);
  PoissonPoints points(rng);
  medium.visit_majorants(ray, inside, [&](const DensityStretch& stretch) {
    const double majorant = densest * stretch.max;  // 1/m
    return points.visit(stretch.t0, stretch.t1, majorant, [&](double t) {
      ++lookups;
      product *= 1.0 - sigma_t * double{stretch.density(t)} / majorant;
      return survives(product, rng);
    });
  });
  return {Rgb(product), lookups};
}

}  // namespace vpm
