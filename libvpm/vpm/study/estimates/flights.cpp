// Flights, one by one.
#include "vpm/study/estimates/flights.h"

#include "vpm/study/sample_moments.h"

namespace vpm {

FlightEstimate estimate_flights(const FlightPath& path, const DistanceStrategy& strategy,
                                const std::vector<double>& distances, double mean, uint64_t flights, uint64_t seed) {
  const Interval interval{0.0f, static_cast<float>(path.length)};
  const size_t n = distances.size();
  const std::vector<Moments> all = sample_moments(n + 3, flights, seed, [&](Rng& rng, double* out) {
    const Flight flight = strategy.sample(path.medium, path.ray, interval, Rgb(1.0f), rng);
    const double weight = flight.weight.r, t = flight.t;
    out[n + 1] = weight * t;
    if (!flight.collided) return;
    for (size_t i = 0; i < n; ++i) out[i] = t < distances[i] ? weight : 0.0;
    out[n] = weight;
    out[n + 2] = weight * (t - mean);
  });
  return {{all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n)}, all[n], all[n + 1], all[n + 2]};
}

double weight_square(const FlightPath& path, double rate) {
  constexpr int kSteps = 4096;
  const double step = path.length / kSteps, sigma_t = path.medium.sigma_t.r;
  double sum = 0.0, tau = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * step;
    const double extinction = sigma_t * double{path.medium.density(path.ray.at(static_cast<float>(t)))};
    // Collided: weight extinction exp(-tau) / (rate exp(-rate t)), drawn with density rate exp(-rate t).
    sum += extinction * extinction / rate * std::exp(rate * t - 2.0 * (tau + 0.5 * extinction * step)) * step;
    tau += extinction * step;
  }
  return sum + std::exp(rate * path.length - 2.0 * tau);
}

}  // namespace vpm
