// Tracking through null collisions: weights of the channels over tentative collisions, and the strategies, which differ
// in their majorants.
#include "vpm/medium/distance/null_collisions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vpm/medium/grid/majorant_of_lookups.h"

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

namespace {

class Delta final : public DistanceStrategy {
 public:
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;
};

class DeltaLocal final : public DistanceStrategy {
 public:
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;
};

class ProgressiveNull final : public DistanceStrategy {
 public:
  /// The majorant of pass 0, as a share of the medium's largest density. It doubles with every pass.
  ProgressiveNull(float majorant, uint64_t pass);
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;

 private:
  double share_;  // the most that a majorant may be of the medium's largest density
};

class Weighted final : public DistanceStrategy {
 public:
  explicit Weighted(float majorant) : majorant_(majorant) {}
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;

 private:
  float majorant_;  // the most that a majorant may be, as a share of the medium's largest density
};

class Decomposition final : public DistanceStrategy {
 public:
  explicit Decomposition(bool needs_density) : needs_density_(needs_density) {}
  Flight sample(const Medium&, const Ray&, const Interval&, const Rgb& power, Rng&) const override;

 private:
  bool needs_density_;  // at collisions
};

// `delta`: tracking through null collisions under one majorant, the medium's largest density [Woodcock1965].
//
// Known failure: a few dense voxels in a thin medium make nearly all collisions null, at a look-up each.
Flight Delta::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power, Rng& rng) const {
  const Interval inside = medium.clip(ray, interval);
  const double majorant = majorant_of_lookups(medium);
  const DensityAlong along = medium.density_along(ray);
  NullCollisionFlight flight(medium, interval, power, rng);
  for (double t = inside.t0; flight.advance(t, inside.t1, majorant);)
    if (flight.meet(t, along.at(t), majorant)) break;
  return flight.result(0);
}

// `delta-local`: tracking through null collisions under the largest density of each brick on the way
// [SzirmayKalos2011]. Empty bricks cost nothing. Without a grid no collision is null, and none is drawn to be.
//
// Known failure: where densities differ much within a brick of 8^3 cells most collisions are null still.
Flight DeltaLocal::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                          Rng& rng) const {
  if (medium.homogeneous()) return homogeneous_flight(medium, interval, power, rng);
  return track_bricks(
      medium, ray, interval, NullCollisionFlight(medium, interval, power, rng), [](float max) { return max; },
      [](NullCollisionFlight& flight, double t, const DensityStretch& stretch, double majorant) {
        return flight.meet(t, stretch, majorant);
      });
}

// `progressive-null`: tracking through null collisions under majorants that need not bound. What exceeds one is cut to
// it, and majorants grow from pass to pass until nothing does [Misso2023]. A pass is biased, without large weights; the
// mean over passes is consistent.
//
// Known failure: the first passes see a medium too thin, and their error leaves the mean only as one over the passes.
ProgressiveNull::ProgressiveNull(float majorant, uint64_t pass)
    : share_(std::min(1.0, double{majorant} * std::exp2(static_cast<double>(pass)))) {}

Flight ProgressiveNull::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                               Rng& rng) const {
  const double most = share_ * static_cast<double>(medium.max_density());
  return track_bricks(
      medium, ray, interval, NullCollisionFlight(medium, interval, power, rng),
      [&](float max) { return std::min<double>(max, most); },
      [](NullCollisionFlight& flight, double t, const DensityStretch& stretch, double majorant) {
        return flight.meet(t, stretch, majorant);
      });
}

// `weighted`: tracking through null collisions under majorants that need not bound. Where the density exceeds one, null
// collisions are of negative weight [Galtier2013; Novak2018]: unbiased, for paths from the eye alone, as the powers of
// photons must not be negative.
//
// Known failure: where the density x exceeds the majorant 1 every tentative collision multiplies the weight by 2 x - 1
// in magnitude, and the variance grows exponentially with their number [Misso2023].
Flight Weighted::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                        Rng& rng) const {
  const double most = double{majorant_} * static_cast<double>(medium.max_density());
  return track_bricks(
      medium, ray, interval, NullCollisionFlight(medium, interval, power, rng),
      [&](float max) { return std::min<double>(max, most); },
      [](NullCollisionFlight& flight, double t, const DensityStretch& stretch, double majorant) {
        return flight.meet_weighted(t, stretch.density(t), majorant);
      });
}

// `decomposition`: the extinction in each brick is the sum of a control part, its least density, whose collisions need
// no look-up, and a residual that is tracked through null collisions [Kutz2017].
//
// The paper draws a distance for each part and takes the nearer one. Two Poisson processes are one, whose points are of
// either kind with the shares of their rates: here one distance is drawn at the rate of both, the brick's largest
// density, and one number decides whether its end is a collision of the control, a real one of the residual, or null.
//
// Known failure: where a brick's least density is far below the others it is `delta-local`; and who needs the density
// at the collision makes up for the look-up saved.
Flight Decomposition::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                             Rng& rng) const {
  return track_bricks(
      medium, ray, interval, NullCollisionFlight(medium, interval, power, rng), [](float max) { return max; },
      [&](NullCollisionFlight& flight, double t, const DensityStretch& stretch, double majorant) {
        if (!flight.is_real(stretch.min / majorant)) return flight.meet(t, stretch, majorant);
        if (needs_density_) flight.count_lookup();
        flight.collide(t, needs_density_ ? stretch.density(t) : stretch.min);
        return true;
      });
}

constexpr std::array kProgressiveNullNumbers{
    Parameter{"majorant", 0.25f, kMajorants, "",
              "in the first pass densities above this fraction of the medium's largest are cut to it; it doubles with "
              "every pass, so that the mean over passes converges"}};
constexpr std::array kWeightedNumbers{Parameter{"majorant", 0.25f, kMajorants, "",
                                                "above this fraction of the medium's largest density, the same in all "
                                                "passes, weights make up for null collisions that are missing"}};

}  // namespace

extern const StrategyInfo kDelta{
    .name = "delta",
    .summary = "exact: null collisions under the medium's largest density",
    .failure = "one dense voxel makes nearly all collisions null, at a look-up each, everywhere",
    .source = "Woodcock1965",
    .make = [](ParameterValues, const FlightUse&) { return made<Delta>(); }};

extern const StrategyInfo kDeltaLocal{.name = "delta-local",
                                      .summary = "exact: null collisions under the largest density of each brick",
                                      .failure = "one dense voxel makes nearly all collisions in its brick null",
                                      .source = "SzirmayKalos2011",
                                      .make = [](ParameterValues, const FlightUse&) { return made<DeltaLocal>(); }};

extern const StrategyInfo kProgressiveNull{
    .name = "progressive-null",
    .summary = "null collisions under majorants that grow from pass to pass; biased until they bound",
    .failure = "the first passes see a medium too thin, which leaves the mean only as 1/passes",
    .source = "Misso2023",
    .unbiased = false,
    .parameters = kProgressiveNullNumbers,
    .make = [](ParameterValues n, const FlightUse& use) { return made<ProgressiveNull>(n[0], use.pass); }};

extern const StrategyInfo kWeighted{
    .name = "weighted",
    .summary = "exact: null collisions under majorants that need not bound, by weights of either sign; for paths",
    .failure =
        "densities above the majorant: weights beyond 1 multiply along the path, and the variance grows "
        "exponentially with the collisions there",
    .source = "Galtier2013",
    .analog = false,
    .bounded_weight = false,
    .positive = false,
    .parameters = kWeightedNumbers,
    .make = [](ParameterValues n, const FlightUse&) { return made<Weighted>(n[0]); }};

extern const StrategyInfo kDecomposition{
    .name = "decomposition",
    .summary = "exact: each brick's least density without look-ups, the rest by null collisions",
    .failure = "bricks whose least density is near 0: there it is delta-local",
    .source = "Kutz2017",
    .make = [](ParameterValues, const FlightUse& use) { return made<Decomposition>(use.density); }};

}  // namespace vpm
