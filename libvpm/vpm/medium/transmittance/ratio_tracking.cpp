// Ratio tracking: look-ups in the points of a Poisson process along the ray, each of which leaves its share of the
// light.
#include "vpm/base/cancel.h"
#include "vpm/base/counters.h"
#include "vpm/base/rng.h"
#include "vpm/base/vec.h"
#include "vpm/medium/grid/majorant_of_lookups.h"
#include "vpm/medium/transmittance/estimator.h"
#include "vpm/medium/transmittance/marched_integrals.h"

namespace vpm {
namespace {

class RatioTransmittance final : public TransmittanceEstimator {
 public:
  TransmittanceEstimate estimate(const Medium&, const Ray&, const Interval&, Rng&) const override;
};

class LocalRatioTransmittance final : public TransmittanceEstimator {
 public:
  TransmittanceEstimate estimate(const Medium&, const Ray&, const Interval&, Rng&) const override;
};

class ResidualRatioTransmittance final : public TransmittanceEstimator {
 public:
  TransmittanceEstimate estimate(const Medium&, const Ray&, const Interval&, Rng&) const override;
};

/// Points of a Poisson process along a ray, at a rate that changes from stretch to stretch: where tracking estimators
/// look.
class PoissonPoints {
 public:
  explicit PoissonPoints(Rng& rng) : rng_(rng), left_(draw()) {}

  /// Calls visit(t) for the points in [t0, t1), m, at `rate`, 1/m, until it returns false; returns whether it never
  /// did. Stretches are visited in order.
  template <class Visit>
  bool visit(double t0, double t1, double rate, Visit&& visit) {
    double t = t0;
    while (left_ < (t1 - t) * rate) {
      cancellation_point();
      t += left_ / rate;
      left_ = draw();
      if (!visit(t)) return false;
    }
    left_ -= (t1 - t) * rate;
    return true;
  }

 private:
  double draw() { return rng_.exponential(); }

  Rng& rng_;
  double left_;  // to the next point: the integral of the rate
};

/// Russian roulette of a product of look-ups once all channels are below 1 %: it survives with probability 1/2 and
/// doubles, or is black. False where it is black.
inline bool survives(Rgbd& product, Rng& rng) {
  constexpr double kRouletteBelow = 0.01;
  const Rgbd size = glm::abs(product);
  const double largest = std::max(size.r, std::max(size.g, size.b));
  if (largest >= kRouletteBelow) return true;
  const bool goes_on = largest > 0.0 && rng.uniform() < 0.5f;
  product *= goes_on ? 2.0 : 0.0;
  return goes_on;
}

/// How the density of a brick is taken apart: into a control, whose transmittance is known, and a residual, which is
/// tracked and nowhere larger than `reach`, either way.
struct BrickSplit {
  double control, reach;
};

/// Tracks the residuals of the bricks on the way; `split` takes a DensityStretch to its BrickSplit.
template <class Split>
TransmittanceEstimate track_bricks(const Medium& medium, const Ray& ray, const Interval& interval, Rng& rng,
                                   Split&& split) {
  const Interval inside = medium.clip(ray, interval);
  if (const auto known = known_transmittance(medium, inside)) return *known;
  const Rgbd sigma_t(medium.sigma_t);
  const double densest = max_channel(medium.sigma_t);
  uint32_t lookups = 0;
  Rgbd product(1.0);
  PoissonPoints points(rng);
  const uint32_t bricks = medium.visit_majorants(ray, inside, [&](const DensityStretch& stretch) {
    const BrickSplit brick = split(stretch);
    const double rate = densest * brick.reach;  // 1/m
    if (brick.control > 0.0) product *= glm::exp(-sigma_t * (brick.control * (stretch.t1 - stretch.t0)));
    return points.visit(stretch.t0, stretch.t1, rate, [&](double t) {
      count(lookups);
      product *= 1.0 - sigma_t * (stretch.density(t) - brick.control) / rate;
      return survives(product, rng);
    });
  });
  return {Rgb(product), lookups, bricks};
}

// `ratio`: ratio tracking. The ray is looked at in the points of a Poisson process at the rate of a majorant of the
// extinction, that of the medium's largest density; each leaves the share 1 - sigma_t / majorant of the light, and the
// product of all is an unbiased transmittance in [0, 1] [Novak2014]. One majorant serves all channels, so that they
// share the look-ups.
//
// Known failure: it is as blind as delta tracking where the density is its majorant: in a constant medium the value is
// 0 or 1. The relative variance is exp(int sigma_t^2 / majorant) - 1; look-ups are as many as the majorant's thickness,
// which one dense voxel anywhere in the medium makes large.
TransmittanceEstimate RatioTransmittance::estimate(const Medium& medium, const Ray& ray, const Interval& interval,
                                                   Rng& rng) const {
  const Interval inside = medium.clip(ray, interval);
  if (const auto known = known_transmittance(medium, inside)) return *known;
  const Rgbd sigma_t(medium.sigma_t);
  const double majorant = double{max_channel(medium.sigma_t)} * majorant_of_lookups(medium);  // 1/m
  const DensityAlong along = medium.density_along(ray);
  uint32_t lookups = 0;
  Rgbd product(1.0);
  PoissonPoints(rng).visit(inside.t0, inside.t1, majorant, [&](double t) {
    count(lookups);
    product *= 1.0 - sigma_t * double{along.at(t)} / majorant;
    return survives(product, rng);
  });
  return {Rgb(product), lookups};
}

// `ratio-local`: ratio tracking under the largest density of each brick of the grid on the way: empty bricks cost
// nothing, and one dense voxel makes look-ups dear in its own brick only [Novak2014].
//
// Known failure: that of `ratio`, and more of its noise: a majorant closer to the density has fewer look-ups, each of
// which decides more.
TransmittanceEstimate LocalRatioTransmittance::estimate(const Medium& medium, const Ray& ray, const Interval& interval,
                                                        Rng& rng) const {
  return track_bricks(medium, ray, interval, rng, [](const DensityStretch& stretch) {
    return BrickSplit{0.0, stretch.max};
  });
}

// `residual-ratio`: residual ratio tracking. The extinction is a control, whose transmittance is known, and a residual,
// which is left to ratio tracking: each look-up leaves the share 1 - residual / (largest residual) [Novak2014].
//
// The control is the middle of the density's bounds in each brick of the grid: of all constants it has the least
// largest residual, half of what the bounds are apart, and needs half the look-ups of `ratio-local` where the least
// density is 0. The relative variance is exp(int residual^2 / largest residual) - 1, no more than exp() of the mean
// number of look-ups. Residuals of either sign: look-ups leave shares from 0 to 2, and values above 1 are legal.
//
// Known failure: a brick that is empty except for a small part. Its residual is nearly maximal almost everywhere;
// ratio tracking, whose look-ups leave the light alone there, is better in such bricks.
TransmittanceEstimate ResidualRatioTransmittance::estimate(const Medium& medium, const Ray& ray,
                                                           const Interval& interval, Rng& rng) const {
  return track_bricks(medium, ray, interval, rng, [](const DensityStretch& stretch) {
    return BrickSplit{0.5 * (double{stretch.max} + stretch.min), 0.5 * (double{stretch.max} - stretch.min)};
  });
}

}  // namespace

extern const EstimatorInfo kRatio{
    .name = "ratio",
    .summary = "product of the shares that look-ups at the rate of the largest density leave",
    .failure =
        "one dense voxel asks for its rate of look-ups everywhere; as noisy as a yes or no where the density "
        "is its majorant",
    .source = "Novak2014",
    .make = [](ParameterValues) -> std::unique_ptr<TransmittanceEstimator> {
      return std::make_unique<RatioTransmittance>();
    }};

extern const EstimatorInfo kRatioLocal{.name = "ratio-local",
                                       .summary = "the same at the rate of the largest density of each brick",
                                       .failure = "one dense voxel asks for its rate of look-ups in all its brick",
                                       .source = "Novak2014",
                                       .make = [](ParameterValues) -> std::unique_ptr<TransmittanceEstimator> {
                                         return std::make_unique<LocalRatioTransmittance>();
                                       }};

extern const EstimatorInfo kResidualRatio{
    .name = "residual-ratio",
    .summary = "the same for what the density is off the middle of each brick's bounds",
    .failure = "bricks that are empty except for a small part: values above 1, heavy tails",
    .source = "Novak2014",
    .make = [](ParameterValues) -> std::unique_ptr<TransmittanceEstimator> {
      return std::make_unique<ResidualRatioTransmittance>();
    }};

}  // namespace vpm
