// Flights by one draw from an exponential law: exact where the density is constant, weighed elsewhere.
#include <cassert>

#include "vpm/base/counters.h"
#include "vpm/medium/distance/mixture.h"
#include "vpm/medium/distance/strategies.h"

namespace vpm {

// `homogeneous`: the exact flight in a medium of constant density [Jarosz2008, eq. 7.6, 7.7 with the rate restored].
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

// `mean-extinction`: exponential flights at the mean rate over the medium's bounds, empty voxels included [Jarosz2008,
// sec. 7.4.1].
//
// Known failure: E[w^2] contains exp(-(2 sigma_t - s) d), which grows without bound along any stretch where sigma_t < s
// / 2: in a cloud with thin edges every sample is unbiased and the variance is enormous.
Flight MeanExtinction::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                              Rng& rng) const {
  return exponential_flight(medium, ray, interval, medium.sigma_t * static_cast<float>(medium.mean_density()), power,
                            rng);
}

// `local-extinction`: exponential flights at the rate of the extinction where the segment starts [Jarosz2008,
// sec. 7.4.1].
//
// Known failure: a dense start followed by thin voxels makes weights exp(s D - tau), which no floor of the rate helps.
Flight LocalExtinction::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                               Rng& rng) const {
  const double floor = extinction_floor_ * medium.mean_density();
  const double density = std::max<double>(medium.density(ray.at(interval.t0)), floor);
  Flight flight = exponential_flight(medium, ray, interval, medium.sigma_t * static_cast<float>(density), power, rng);
  count(flight.lookups);
  return flight;
}

}  // namespace vpm
