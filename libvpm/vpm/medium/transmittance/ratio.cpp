// `ratio`: ratio tracking. The ray is looked at in the points of a Poisson process at the rate of a majorant of the
// extinction, that of the medium's largest density; each leaves the share 1 - sigma_t / majorant of the light, and the
// product of all is an unbiased transmittance in [0, 1] [Novak2014]. One majorant serves all channels, so that they
// share the look-ups.
//
// Known failure: it is as blind as delta tracking where the density is its majorant: in a constant medium the value is
// 0 or 1. The relative variance is exp(int sigma_t^2 / majorant) - 1; look-ups are as many as the majorant's thickness,
// which one dense voxel anywhere in the medium makes large.
#include "vpm/base/count.h"
#include "vpm/medium/majorant_of_lookups.h"
#include "vpm/medium/transmittance/estimators.h"
#include "vpm/medium/transmittance/marched_integrals.h"
#include "vpm/medium/transmittance/poisson_points.h"

namespace vpm {

TransmittanceEstimate RatioTransmittance::estimate(const Medium& medium, const Ray& ray, const Interval& interval,
                                                   Rng& rng) const {
  const Interval inside = medium.clip(ray, interval);
  if (const auto known = known_transmittance(medium, inside)) return *known;
  const Rgbd sigma_t(medium.sigma_t);
  const double majorant = double{max_channel(medium.sigma_t)} * majorant_of_lookups(medium);  // 1/m
  const DensityAlong along = medium.density_along(ray);
  uint32_t lookups = 0;
  Rgbd product(1.0);
  PoissonPoints(rng).visit(inside.t0, inside.t1, majorant, [&](double t) {
    count(lookups);
    product *= 1.0 - sigma_t * double{along.at(t)} / majorant;
    return survives(product, rng);
  });
  return {Rgb(product), lookups};
}

}  // namespace vpm
