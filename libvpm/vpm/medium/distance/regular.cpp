// `regular`: the exact flight through any density: the ray's cells are walked, and the quartic density integral of the
// cell where the flight ends is inverted [Novak2018, sec. 4.1]. Needs no majorant.
#include "vpm/medium/distance/mixture.h"
#include "vpm/medium/distance/strategies.h"

namespace vpm {

Flight Regular::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                       Rng& rng) const {
  const Rgb shares = channel_shares(power);
  const double sigma_t = pick_channel(medium.sigma_t, shares, rng.uniform());
  const double target = rng.exponential() / sigma_t;  // density integral to cross; infinite at sigma_t = 0
  Flight flight;
  flight.t = interval.t1;
  double crossed = 0.0;
  flight.lookups = medium.visit_pieces(ray, interval, [&](const DensityPiece& piece) {
    const double here = piece.integral();
    if (crossed + here <= target) {
      crossed += here;
      return true;
    }
    const double s = piece.invert(target - crossed);
    flight.collided = true;
    flight.t = static_cast<float>(piece.t0 + s);
    flight.density = static_cast<float>(piece.density(s));
    crossed = target;
    return false;
  });
  flight.integral = crossed;
  flight.weight = analog_weight(medium, shares, crossed, flight.collided);
  return flight;
}

}  // namespace vpm
