// Flights by one draw from an exponential law: exact where the density is constant, weighed elsewhere.
#include <array>

#include "vpm/base/counters.h"
#include "vpm/medium/distance/mixture.h"

namespace vpm {
namespace {

class Homogeneous final : public DistanceStrategy {
 public:
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;
};

class LocalExtinction final : public DistanceStrategy {
 public:
  explicit LocalExtinction(float extinction_floor) : extinction_floor_(extinction_floor) {}
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;

 private:
  float extinction_floor_;  // as a fraction of the mean extinction
};

class MeanExtinction final : public DistanceStrategy {
 public:
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;
};

Flight Homogeneous::sample(const Medium& medium, const Ray&, const Interval& interval, const Rgb& power,
                           Rng& rng) const {
  return homogeneous_flight(medium, interval, power, rng);
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

constexpr std::array kLocalExtinctionNumbers{
    Parameter{"extinction_floor", 0.1f, kPositive, "", "least rate, as a fraction of the mean one"}};

}  // namespace

extern const StrategyInfo kHomogeneous{.name = "homogeneous",
                                       .summary = "exact in a medium of constant density",
                                       .failure = "no other medium: refused in grids",
                                       .source = "Jarosz2008",
                                       .heterogeneous = false,
                                       .make = [](ParameterValues, const FlightUse&) { return made<Homogeneous>(); }};

extern const StrategyInfo kLocalExtinction{
    .name = "local-extinction",
    .summary = "exponential at the rate where the segment starts; weights without bound",
    .failure = "a dense start followed by thin voxels: flights that leave have weights without bound",
    .source = "Jarosz2008",
    .analog = false,
    .bounded_weight = false,
    .parameters = kLocalExtinctionNumbers,
    .make = [](ParameterValues n, const FlightUse&) { return made<LocalExtinction>(n[0]); }};

extern const StrategyInfo kMeanExtinction{
    .name = "mean-extinction",
    .summary = "exponential at the medium's mean rate; weights without bound",
    .failure = "stretches below half the mean extinction: the variance grows without bound along them",
    .source = "Jarosz2008",
    .analog = false,
    .bounded_weight = false,
    .make = [](ParameterValues, const FlightUse&) { return made<MeanExtinction>(); }};

}  // namespace vpm
