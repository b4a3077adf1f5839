// `ratio`: ratio tracking. The ray is looked at in the points of a Poisson process at the rate of a majorant of the
// extinction; each leaves the share 1 - sigma_t / majorant of the light, and the product of all is an unbiased
// transmittance in [0, 1] [Novak2014]. One majorant serves all channels, so that they share the look-ups.
//
// Known failure: it is as blind as delta tracking where the density is its majorant: in a constant medium the value is
// 0 or 1. The relative variance is exp(int sigma_t^2 / majorant) - 1, so that a looser majorant gives less noise for
// more look-ups, whose mean number is the majorant's column.
#include "medium/transmittance/estimators.h"
#include "medium/transmittance/marched_columns.h"
#include "medium/transmittance/poisson_points.h"

namespace vpm {

TransmittanceEstimate RatioTransmittance::estimate(const Medium& medium, const Ray& ray, const Interval& interval,
                                                   Rng& rng) const {
  const Interval inside = medium.clip(ray, interval);
  if (const auto known = known_transmittance(medium, inside)) return *known;
  const Rgbd sigma_t(medium.sigma_t);
  const double densest = max_channel(medium.sigma_t);
  uint32_t lookups = 0;
  Rgbd product(1.0);
  PoissonPoints points(rng);
  const auto track = [&](double t0, double t1, float, float most) {
    const double majorant = densest * most;  // 1/m
    return points.visit(t0, t1, majorant, [&](double t) {
      ++lookups;
      const double density = medium.density(ray.at(static_cast<float>(t)));
      product *= 1.0 - sigma_t * density / majorant;
      return survives(product, rng);
    });
  };
  if (majorants_ == Majorants::local)
    medium.visit_majorants(ray, inside, track);
  else
    track(inside.t0, inside.t1, 0.0f, medium.max_density());
  return {Rgb(product), lookups};
}

}  // namespace vpm
