// Weights of the channels over tentative collisions.
#include "vpm/medium/distance/null_collisions.h"

#include <algorithm>

namespace vpm {
namespace {

/// The share of a photon's power below which a channel is given up: in an endless medium one without extinction would
/// never see the others end.
constexpr double kNothing = 1e-30;

}  // namespace

NullCollisionFlight::NullCollisionFlight(const Medium& medium, const Interval& interval, const Rgb& power, Rng& rng)
    : rng_(rng),
      sigma_t_(medium.sigma_t.r),
      grey_(is_grey(medium.sigma_t)),
      coefficients_(medium.sigma_t),
      shares_(channel_shares(power)) {
  flight_.t = interval.t1;
  if (!grey_) drop_exhausted_channels();
}

// Of a channel x collides and 1 - x goes on, in majorants. What happens is drawn by the means of their magnitudes over
// the channels, so that neither is left out where any channel has some of it.
bool NullCollisionFlight::meet_beyond(double t, float density, double majorant) {
  count(flight_.lookups);
  ++flight_.majorant_violations;
  const double share = density / majorant;
  const Rgbd null = 1.0 - coefficients_ / sigma_t_ * share;
  const double real = chance_ * share, rest = glm::dot(shares_ * glm::abs(weight_), glm::abs(null));
  flight_.weight *= static_cast<float>(real + rest);
  if (decision_ * (real + rest) < real) {
    collide(t, density);
    return true;
  }
  count(flight_.null_collisions);
  if (grey_) {
    flight_.weight *= Rgb(null / rest);
  } else {
    weight_ *= null / rest;
    drop_exhausted_channels();
  }
  return false;
}

void NullCollisionFlight::weigh_null(double share) {
  weight_ *= (1.0 - coefficients_ / sigma_t_ * share) / (1.0 - chance_ * share);
  drop_exhausted_channels();
}

void NullCollisionFlight::drop_exhausted_channels() {
  sigma_t_ = 0.0;
  for (int c = 0; c < 3; ++c)
    if (shares_[c] * std::abs(weight_[c]) >= kNothing)
      sigma_t_ = std::max(sigma_t_, coefficients_[c]);
    else
      weight_[c] = 0.0;
  chance_ = sigma_t_ > 0.0 ? glm::dot(shares_ * glm::abs(weight_), coefficients_) / sigma_t_ : 0.0;
}

Flight NullCollisionFlight::result(uint32_t bricks) const {
  Flight flight = flight_;
  flight.bricks = bricks;
  if (grey_) return flight;
  flight.weight *= Rgb(flight.collided ? weight_ * coefficients_ / (chance_ * sigma_t_) : weight_);
  return flight;
}

}  // namespace vpm
