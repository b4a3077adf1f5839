// `local-extinction`: exponential flights at the rate of the extinction where the segment starts [Jarosz2008,
// sec. 7.4.1].
//
// Known failure: a dense start followed by thin voxels makes weights exp(s D - tau), which no floor of the rate helps.
#include "vpm/base/count.h"
#include "vpm/medium/distance/mixture.h"
#include "vpm/medium/distance/strategies.h"

namespace vpm {

Flight LocalExtinction::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                               Rng& rng) const {
  const double floor = extinction_floor_ * medium.mean_density();
  const double density = std::max<double>(medium.density(ray.at(interval.t0)), floor);
  Flight flight = exponential_flight(medium, ray, interval, medium.sigma_t * static_cast<float>(density), power, rng);
  count(flight.lookups);
  return flight;
}

}  // namespace vpm
