// Level 4: the bias of ray marching falls as the square of its step. Along the diagonal of a density x y the field is a
// parabola, whose density integral the midpoint rule misses by step^2 / 24 times the second derivative times the
// length, exactly.
#include <fmt/format.h>

#include <cmath>

#include "vpm/medium/distance/strategy.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"

namespace vpm {
namespace {

constexpr double kFrom = 1.0, kTo = 17.0;  // x = y along the ray, in voxels of 1 m

Medium parabola() {
  GridFrame frame;
  frame.lo = Vec3i(0);
  frame.hi = Vec3i(20);
  return make_medium(make_grid(frame, [](int x, int y, int) { return x * y; }), Rgb(8e-4f));  // 1/m
}

/// What gets through by marching in steps of `step` m, less what gets through.
double exact_bias(const Medium& medium, double step) {
  const double root = std::sqrt(2.0), length = root * (kTo - kFrom);
  const double integral = root * (std::pow(kTo, 3.0) - std::pow(kFrom, 3.0)) / 3.0;
  const double missed = step * step / 24.0 * length;  // the second derivative is 1/m^2
  const double sigma_t = medium.sigma_t.r;
  return std::exp(-sigma_t * (integral - missed)) - std::exp(-sigma_t * integral);
}

std::vector<Check> march_bias(const Effort& effort) {
  const Medium medium = parabola();
  const Ray ray{Vec3(kFrom, kFrom, 8.5f), glm::normalize(Vec3(1, 1, 0))};
  const double length = std::sqrt(2.0) * (kTo - kFrom);
  const Interval stretch{0.0f, static_cast<float>(length)};
  const auto exact = make_distance_strategy({.strategy = "regular"});
  std::vector<Check> checks;
  std::vector<double> biases, errors, steps;
  for (const double parts : {2.0, 4.0, 8.0}) {
    const double step = length / parts;
    const auto marched = make_distance_strategy({"ray-march", {{"step", static_cast<float>(step)}}});
    const uint64_t seed = effort.seed_of(fmt::format("march bias {}", parts));
    // Both flights have the same random numbers, so that the march passes wherever the exact flight does: the bias is
    // the probability that it passes alone.
    const Moments alone = sample_moments(1, effort.count(200'000, 2'000'000), seed, [&](Rng& rng, double* out) {
      Rng same = rng;
      const bool passed = !exact->sample(medium, ray, stretch, Rgb(1.0f), same).collided;
      out[0] = double(!marched->sample(medium, ray, stretch, Rgb(1.0f), rng).collided) - passed;
    })[0];
    checks.push_back(check_probability(fmt::format("ray-march: bias of the transmittance, {} steps", parts), alone,
                                       exact_bias(medium, step)));
    steps.push_back(step);
    biases.push_back(alone.mean());
    errors.push_back(std::sqrt(alone.variance_of_mean()) / alone.mean());
  }
  const auto slope = [&](double first, double last) { return std::log(first / last) / std::log(steps[0] / steps[2]); };
  checks.push_back(check_value("ray-march: slope of the bias over the step", slope(biases[0], biases[2]),
                               std::hypot(errors[0], errors[2]) / std::log(steps[0] / steps[2]),
                               slope(exact_bias(medium, steps[0]), exact_bias(medium, steps[2]))));
  checks.back().note = "2 for small steps; of the first and the last bias above";
  return checks;
}

}  // namespace

std::vector<Experiment> march_experiments() { return {{4, "ray marching: bias and step", march_bias}}; }

}  // namespace vpm
