// `ray-march-adaptive`: as `ray-march`, in steps of a constant optical thickness under the largest density of each
// brick on the way. Bricks of one density take one step and empty ones none, as homogeneous and empty regions do in
// [Danskin1992].
//
// Steps divide the ray's part of a brick evenly. They are `step` voxels at most, and not below a sixteenth of that.
// Each takes the density at its middle and the flight's end is solved for inside the step: a bias of O(step^2) where
// the density is continuous, of O(step) across the jumps of nearest voxels, as in `ray-march`. Known failure: spikes
// thinner than a step are missed.
#include <algorithm>

#include "vpm/base/cancel.h"
#include "vpm/base/count.h"
#include "vpm/medium/distance/mixture.h"
#include "vpm/medium/distance/strategies.h"

namespace vpm {
namespace {

constexpr double kShortest = 1.0 / 16.0;  // of the longest step: very dense media would never come to an end

}  // namespace

Flight RayMarchAdaptive::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                                Rng& rng) const {
  const Rgb shares = channel_shares(power);
  const double sigma_t = pick_channel(medium.sigma_t, shares, rng.uniform());
  const double target = rng.exponential() / sigma_t;  // density integral to cross; infinite at sigma_t = 0
  const double longest = step_ * static_cast<double>(medium.voxel_size());
  const double integral_of_step = optical_step_ / static_cast<double>(max_channel(medium.sigma_t));
  Flight flight;
  flight.t = interval.t1;
  double crossed = 0.0;
  flight.bricks = medium.visit_majorants(ray, interval, [&](const DensityStretch& stretch) {
    cancellation_point();
    const double wanted = std::clamp(integral_of_step / stretch.max, kShortest * longest, longest);
    const double steps = stretch.uniform() ? 1.0 : std::ceil((stretch.t1 - stretch.t0) / wanted);
    const double length = (stretch.t1 - stretch.t0) / steps;
    double t = stretch.t0;
    for (double i = 0.0; i < steps; ++i, t += length) {
      const double density = stretch.density(t + 0.5 * length);
      count(flight.lookups);
      if (crossed + density * length > target) {
        flight.collided = true;
        flight.density = static_cast<float>(density);
        flight.t = static_cast<float>(t + (target - crossed) / density);
        crossed = target;
        return false;
      }
      crossed += density * length;
    }
    return true;
  });
  flight.weight = analog_weight(medium, shares, crossed, flight.collided);
  return flight;
}

}  // namespace vpm
