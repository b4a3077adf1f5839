// `weighted`: tracking through null collisions under majorants that need not bound. Where the density exceeds one, null
// collisions are of negative weight [Galtier2013; Novak2018]: unbiased, for paths from the eye alone, as the powers of
// photons must not be negative.
//
// Known failure: where the density x exceeds the majorant 1 every tentative collision multiplies the weight by 2 x - 1
// in magnitude, and the variance grows exponentially with their number [Misso2023].
#include <algorithm>

#include "vpm/medium/distance/null_collisions.h"
#include "vpm/medium/distance/strategies.h"

namespace vpm {

Flight Weighted::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                        Rng& rng) const {
  const double most = double{majorant_} * static_cast<double>(medium.max_density());
  return track_bricks(
      medium, ray, interval, NullCollisionFlight(medium, interval, power, rng),
      [&](float max) { return std::min<double>(max, most); },
      [](NullCollisionFlight& flight, double t, const DensityStretch& stretch, double majorant) {
        return flight.meet_weighted(t, stretch.density(t), majorant);
      });
}

}  // namespace vpm
