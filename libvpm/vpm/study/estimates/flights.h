// Free flights along one ray: where photons collide, as a distance strategy draws it.
#pragma once

#include <vector>

#include "vpm/base/statistics/moments.h"
#include "vpm/medium/distance/strategy.h"

namespace vpm {

/// A segment of a ray through a medium, from the origin of the ray.
struct FlightPath {
  Medium medium;
  Ray ray;
  double length = 0.0;  // m
};

/// A sample is a flight; weights are those of the strategy.
struct FlightEstimate {
  std::vector<Moments> collided_before;  // each of the given distances
  Moments collided;
  Moments reach;   // distance flown, at most the length, m
  Moments excess;  // distance less `mean` where the flight collided, otherwise 0, m
};

/// `mean` is what the distance of collisions should be on average, m.
FlightEstimate estimate_flights(const FlightPath& path, const DistanceStrategy& strategy,
                                const std::vector<double>& distances, double mean, uint64_t flights, uint64_t seed);

/// E[w^2] of the weights of flights drawn from exp(-rate t), rate in 1/m, by quadrature. The number of flights over it
/// is the effective sample size, even where the flights drawn happen to hold none of the rare large weights.
double weight_square(const FlightPath& path, double rate);

}  // namespace vpm
