// `ray-march`: transmittance is accumulated in fixed steps until it reaches the random number [Jarosz2008, sec. 7.4.1].
//
// Each step takes the density at its middle and the flight's end is solved for inside the step, so the bias is
// O(step^2); taking the first sample beyond the random number, as printed, would leave O(step). Known failure: spikes
// thinner than a step are missed.
#include "vpm/base/cancel.h"
#include "vpm/base/count.h"
#include "vpm/medium/distance/mixture.h"
#include "vpm/medium/distance/strategies.h"

namespace vpm {
namespace {

constexpr uint32_t kStepsBetweenLooks = 256;  // at whether the work is given up

}  // namespace

Flight RayMarch::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                        Rng& rng) const {
  const Rgb shares = channel_shares(power);
  const double sigma_t = pick_channel(medium.sigma_t, shares, rng.uniform());
  const double target = rng.exponential() / sigma_t;
  const Interval inside = medium.clip(ray, interval);
  const double length = step_ * static_cast<double>(medium.voxel_size());
  const DensityAlong along = medium.density_along(ray);
  Flight flight;
  flight.t = interval.t1;
  double crossed = 0.0;
  uint32_t steps = 0;
  for (double t = inside.t0; t < inside.t1 && sigma_t > 0.0; t += length) {
    if (++steps % kStepsBetweenLooks == 0) cancellation_point();
    const double end = std::min(t + length, static_cast<double>(inside.t1));
    const double density = along.at(std::isinf(end) ? t : 0.5 * (t + end));
    count(flight.lookups);
    if (crossed + density * (end - t) > target) {
      flight.collided = true;
      flight.density = static_cast<float>(density);
      flight.t = static_cast<float>(t + (target - crossed) / density);
      crossed = target;
      break;
    }
    if (density > 0.0) crossed += density * (end - t);
  }
  if (sigma_t == 0.0) {  // nothing ends the march of a channel without extinction: only the others' weights ask for it
    const DensityIntegral through = density_integral(medium, ray, interval);
    crossed = through.value;
    count(flight.lookups, through.lookups);
  }
  flight.weight = analog_weight(medium, shares, crossed, flight.collided);
  return flight;
}

}  // namespace vpm
