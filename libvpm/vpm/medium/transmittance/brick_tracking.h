// Ratio tracking from brick to brick of a grid.
#pragma once

#include "vpm/base/count.h"
#include "vpm/medium/transmittance/estimators.h"
#include "vpm/medium/transmittance/marched_integrals.h"
#include "vpm/medium/transmittance/poisson_points.h"

namespace vpm {

/// How the density of a brick is taken apart: into a control, whose transmittance is known, and a residual, which is
/// tracked and nowhere larger than `reach`, either way.
struct BrickSplit {
  double control, reach;
};

/// Tracks the residuals of the bricks on the way; `split` takes a DensityStretch to its BrickSplit.
template <class Split>
TransmittanceEstimate track_bricks(const Medium& medium, const Ray& ray, const Interval& interval, Rng& rng,
                                   Split&& split) {
  const Interval inside = medium.clip(ray, interval);
  if (const auto known = known_transmittance(medium, inside)) return *known;
  const Rgbd sigma_t(medium.sigma_t);
  const double densest = max_channel(medium.sigma_t);
  uint32_t lookups = 0;
  Rgbd product(1.0);
  PoissonPoints points(rng);
  const uint32_t bricks = medium.visit_majorants(ray, inside, [&](const DensityStretch& stretch) {
    const BrickSplit brick = split(stretch);
    const double rate = densest * brick.reach;  // 1/m
    if (brick.control > 0.0) product *= glm::exp(-sigma_t * (brick.control * (stretch.t1 - stretch.t0)));
    return points.visit(stretch.t0, stretch.t1, rate, [&](double t) {
      count(lookups);
      product *= 1.0 - sigma_t * (stretch.density(t) - brick.control) / rate;
      return survives(product, rng);
    });
  });
  return {Rgb(product), lookups, bricks};
}

}  // namespace vpm
