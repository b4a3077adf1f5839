// `progressive-null`: tracking through null collisions under majorants that need not bound. What exceeds one is cut to
// it, and majorants grow from pass to pass until nothing does [Misso2023]. A pass is biased, without large weights; the
// mean over passes is consistent.
//
// Known failure: the first passes see a medium too thin, and their error leaves the mean only as one over the passes.
#include <algorithm>
#include <cmath>

#include "medium/distance/null_collisions.h"
#include "medium/distance/strategies.h"

namespace vpm {

ProgressiveNull::ProgressiveNull(float majorant, uint64_t pass)
    : share_(std::min(1.0, double{majorant} * std::exp2(static_cast<double>(pass)))) {}

Flight ProgressiveNull::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                               Rng& rng) const {
  const double most = share_ * static_cast<double>(medium.max_density());
  NullCollisionFlight flight(medium, interval, power, rng);
  const uint32_t bricks = medium.visit_majorants(ray, interval, [&](const DensityStretch& stretch) {
    const double majorant = std::min<double>(stretch.max, most);
    for (double t = stretch.t0; flight.advance(t, stretch.t1, majorant);)
      if (flight.meet(t, stretch.density(t), majorant)) return false;
    return true;
  });
  flight.count_bricks(bricks);
  return flight.result();
}

}  // namespace vpm
