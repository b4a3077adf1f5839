// Flights that end where the optical thickness on the way reaches a random number: summed exactly, or by steps.
#include <algorithm>
#include <array>

#include "vpm/base/cancel.h"
#include "vpm/base/counters.h"
#include "vpm/medium/distance/mixture.h"

namespace vpm {
namespace {

class Regular final : public DistanceStrategy {
 public:
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;
};

class RayMarch final : public DistanceStrategy {
 public:
  explicit RayMarch(float step) : step_(step) {}
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;

 private:
  float step_;  // in voxels
};

class RayMarchAdaptive final : public DistanceStrategy {
 public:
  RayMarchAdaptive(float step, float optical_step) : step_(step), optical_step_(optical_step) {}
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;

 private:
  float step_;          // the longest, in voxels
  float optical_step_;  // optical thickness of a step, under the largest density around
};

// `regular`: the exact flight through any density: the ray's cells are walked, and the quartic density integral of the
// cell where the flight ends is inverted [Novak2018, sec. 4.1]. Needs no majorant.
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

// `ray-march`: transmittance is accumulated in fixed steps until it reaches the random number [Jarosz2008, sec. 7.4.1].
//
// Each step takes the density at its middle and the flight's end is solved for inside the step, so the bias is
// O(step^2); taking the first sample beyond the random number, as printed, would leave O(step). Known failure: spikes
// thinner than a step are missed.
constexpr uint32_t kStepsBetweenLooks = 256;  // at whether the work is given up

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

// `ray-march-adaptive`: as `ray-march`, in steps of a constant optical thickness under the largest density of each
// brick on the way. Bricks of one density take one step and empty ones none, as homogeneous and empty regions do in
// [Danskin1992].
//
// Steps divide the ray's part of a brick evenly. They are `step` voxels at most, and not below a sixteenth of that.
// Each takes the density at its middle and the flight's end is solved for inside the step: a bias of O(step^2) where
// the density is continuous, of O(step) across the jumps of nearest voxels, as in `ray-march`. Known failure: spikes
// thinner than a step are missed.
constexpr double kShortest = 1.0 / 16.0;  // of the longest step: very dense media would never come to an end

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

constexpr std::array kRayMarchNumbers{Parameter{"step", 1.0f, kVoxels, "voxels", "length of a step"}};
constexpr std::array kRayMarchAdaptiveNumbers{
    Parameter{"step", 1.0f, kVoxels, "voxels", "length of the longest step"},
    Parameter{
        "optical_step",
        0.1f,
        {1e-4, kNoLimit, false, true},
        "",
        "optical thickness of a step under the largest density around; steps are not below a sixteenth of `step`"}};

}  // namespace

extern const StrategyInfo kRegular{
    .name = "regular",
    .summary = "exact in any medium: cells walked, the quartic density integral inverted",
    .failure = "a step for every cell crossed, however thin the medium is there",
    .source = "Novak2018",
    .make = [](ParameterValues, const FlightUse&) { return made<Regular>(); }};

extern const StrategyInfo kRayMarch{
    .name = "ray-march",
    .summary = "marched until the transmittance reaches the random number; bias falls as step^2",
    .failure = "spikes thinner than a step are missed",
    .source = "Jarosz2008",
    .unbiased = false,
    .marches = true,
    .parameters = kRayMarchNumbers,
    .make = [](ParameterValues n, const FlightUse&) { return made<RayMarch>(n[0]); }};

extern const StrategyInfo kRayMarchAdaptive{
    .name = "ray-march-adaptive",
    .summary = "the same in steps of an optical thickness, by local majorants; bias falls as step^2",
    .failure =
        "spikes thinner than a step, which a spike in the same brick shortens to a sixteenth at the least, "
        "are missed",
    .source = "Danskin1992",
    .unbiased = false,
    .marches = true,
    .parameters = kRayMarchAdaptiveNumbers,
    .make = [](ParameterValues n, const FlightUse&) { return made<RayMarchAdaptive>(n[0], n[1]); }};

}  // namespace vpm
