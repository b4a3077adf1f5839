// `progressive-null`: tracking through null collisions under majorants that need not bound. What exceeds one is cut to
// it, and majorants grow from pass to pass until nothing does [Misso2023]. A pass is biased, without large weights; the
// mean over passes is consistent.
//
// Known failure: the first passes see a medium too thin, and their error leaves the mean only as one over the passes.
#include <algorithm>
#include <cmath>

#include "vpm/medium/distance/null_collisions.h"
#include "vpm/medium/distance/strategies.h"

namespace vpm {

ProgressiveNull::ProgressiveNull(float majorant, uint64_t pass)
    : share_(std::min(1.0, double{majorant} * std::exp2(static_cast<double>(pass)))) {}

Flight ProgressiveNull::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                               Rng& rng) const {
  const double most = share_ * static_cast<double>(medium.max_density());
  return track_bricks(
      medium, ray, interval, NullCollisionFlight(medium, interval, power, rng),
      [&](float max) { return std::min<double>(max, most); },
      [](NullCollisionFlight& flight, double t, const DensityStretch& stretch, double majorant) {
        return flight.meet(t, stretch, majorant);
      });
}

}  // namespace vpm
