// Weights of flights under the channel mixture.
#include "vpm/medium/distance/mixture.h"

#include <cassert>

#include "vpm/base/counters.h"

namespace vpm {
namespace {

/// Stands for an infinite length, m, or density integral, so that a rate of zero times it is zero. It is far above what
/// densities and lengths that are floats can reach, and products with coefficients that are floats remain finite.
constexpr double kEndless = 1e200;

}  // namespace

Rgb analog_weight(const Medium& medium, const Rgb& shares, double integral, bool collided) {
  if (is_grey(medium.sigma_t)) return Rgb(1.0f);
  const Rgbd sigma_t(medium.sigma_t);
  // The largest transmittance is taken out, so that deep density integrals do not underflow in numerator and
  // denominator.
  const double least = std::min(sigma_t.r, std::min(sigma_t.g, sigma_t.b));
  Rgbd value = glm::exp(-(sigma_t - least) * std::min(integral, kEndless));
  if (collided) value *= sigma_t;
  return Rgb(value / glm::dot(Rgbd(shares), value));
}

Flight homogeneous_flight(const Medium& medium, const Interval& interval, const Rgb& power, Rng& rng) {
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

Flight exponential_flight(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& rate,
                          const Rgb& power, Rng& rng) {
  const Rgbd shares(channel_shares(power));
  const double drawn = pick_channel(rate, Rgb(shares), rng.uniform());
  const double target = rng.exponential();
  const double reach = std::min<double>(interval.length(), kEndless);
  const double distance = drawn > 0.0 ? target / drawn : kEndless;
  Flight flight;
  flight.collided = distance < reach;
  flight.t = flight.collided ? interval.t0 + static_cast<float>(distance) : interval.t1;
  // The distance as it was rounded: against the density integral up to there a finer one would weigh by exp(rate *
  // rounding).
  const double length = flight.collided ? static_cast<double>(flight.t) - interval.t0 : reach;
  const DensityIntegral crossed = density_integral(medium, ray, {interval.t0, flight.t});
  flight.lookups = crossed.lookups;
  // Transmittance over density: the exponents are joined before exp(), as each alone can underflow.
  const Rgbd sigma_t(medium.sigma_t);
  const Rgbd rates(rate);
  Rgbd numerator(1.0);
  Rgbd factor(1.0);
  if (flight.collided) {
    flight.density = medium.density(ray.at(flight.t));
    count(flight.lookups);
    numerator = sigma_t * static_cast<double>(flight.density);
    factor = rates;
  }
  const Rgbd mixed = shares * factor;
  for (int c = 0; c < 3; ++c) {
    double density = 0.0;  // of the mixture over the transmittance of channel c
    for (int j = 0; j < 3; ++j)
      if (mixed[j] > 0.0)
        density += mixed[j] * std::exp(sigma_t[c] * std::min(crossed.value, kEndless) - rates[j] * length);
    flight.weight[c] = static_cast<float>(numerator[c] / density);
  }
  return flight;
}

}  // namespace vpm
