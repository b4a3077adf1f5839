// `homogeneous`: the exact flight in a medium of constant density [Jarosz2008, eq. 7.6, 7.7 with the rate restored].
#include <cassert>

#include "vpm/medium/distance/mixture.h"
#include "vpm/medium/distance/strategies.h"

namespace vpm {

Flight Homogeneous::sample(const Medium& medium, const Ray&, const Interval& interval, const Rgb& power,
                           Rng& rng) const {
  assert(medium.homogeneous());
  const Rgb shares = channel_shares(power);
  const double sigma_t = pick_channel(medium.sigma_t, shares, rng.uniform());
  const double target = rng.exponential();
  const double reach = interval.length();
  Flight flight;
  flight.collided = target < sigma_t * reach;
  const double length = flight.collided ? target / sigma_t : reach;
  flight.t = flight.collided ? interval.t0 + static_cast<float>(length) : interval.t1;
  flight.density = 1.0f;
  flight.integral = length;
  flight.weight = analog_weight(medium, shares, length, flight.collided);
  return flight;
}

}  // namespace vpm
