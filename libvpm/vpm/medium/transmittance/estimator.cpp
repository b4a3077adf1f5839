// The list of transmittance estimators, and the exact one.
#include "vpm/medium/transmittance/estimator.h"

#include <array>

#include "vpm/medium/transmittance/estimators.h"

namespace vpm {

std::span<const EstimatorInfo> transmittance_estimators() {
  static constexpr std::array<EstimatorInfo, 7> kEstimators{{
      {.name = "regular",
       .summary = "exact: the density integral of every cell along the ray",
       .failure = "a step for every cell crossed, however thin the medium is there",
       .source = "Novak2018"},
      {.name = "ratio",
       .summary = "product of the shares that look-ups at the rate of the largest density leave",
       .failure = "one dense voxel asks for its rate of look-ups everywhere; as noisy as a yes or no where the density "
                  "is its majorant",
       .source = "Novak2014"},
      {.name = "ratio-local",
       .summary = "the same at the rate of the largest density of each brick",
       .failure = "one dense voxel asks for its rate of look-ups in all its brick",
       .source = "Novak2014"},
      {.name = "residual-ratio",
       .summary = "the same for what the density is off the middle of each brick's bounds",
       .failure = "bricks that are empty except for a small part: values above 1, heavy tails",
       .source = "Novak2014"},
      {.name = "unbiased-ray-march",
       .summary = "power series of the density integrals of a few marches, mostly of one",
       .failure = "spikes thinner than a march's steps: rare terms of great size, of either sign",
       .source = "Kettunen2021"},
      {.name = "ray-march",
       .summary = "quadrature in equal steps with one random offset; bias falls as step^2",
       .failure = "spikes thinner than a step; by Jensen's inequality too bright on average",
       .source = "Jarosz2008",
       .unbiased = false},
      {.name = "jackknife",
       .summary = "two marches with a random offset in each step, joined; bias falls faster than one's",
       .failure = "few steps in a dense medium: errors far from normal, values below 0",
       .source = "Peters2025",
       .unbiased = false},
  }};
  return kEstimators;
}

std::unique_ptr<TransmittanceEstimator> make_transmittance_estimator(const TransmittanceSettings& settings) {
  if (settings.estimator == "regular") return std::make_unique<RegularTransmittance>();
  if (settings.estimator == "ratio") return std::make_unique<RatioTransmittance>();
  if (settings.estimator == "ratio-local") return std::make_unique<LocalRatioTransmittance>();
  if (settings.estimator == "residual-ratio") return std::make_unique<ResidualRatioTransmittance>();
  if (settings.estimator == "unbiased-ray-march")
    return std::make_unique<UnbiasedRayMarchedTransmittance>(settings.samples);
  if (settings.estimator == "ray-march") return std::make_unique<RayMarchedTransmittance>(settings.step);
  if (settings.estimator == "jackknife") return std::make_unique<JackknifeTransmittance>(settings.step);
  return nullptr;
}

// `regular`: exact transmittance, from the exact density integral of the cells along the ray [Novak2018, sec. 4.1].
TransmittanceEstimate RegularTransmittance::estimate(const Medium& medium, const Ray& ray, const Interval& interval,
                                                     Rng&) const {
  const DensityIntegral crossed = density_integral(medium, ray, interval);
  return {transmittance(medium, crossed.value), crossed.lookups};
}

}  // namespace vpm
