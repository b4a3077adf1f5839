// The classes behind the names of the transmittance estimators.
#pragma once

#include "vpm/medium/transmittance/estimator.h"

namespace vpm {

class RegularTransmittance final : public TransmittanceEstimator {
 public:
  TransmittanceEstimate estimate(const Medium&, const Ray&, const Interval&, Rng&) const override;
};

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

class UnbiasedRayMarchedTransmittance final : public TransmittanceEstimator {
 public:
  explicit UnbiasedRayMarchedTransmittance(float samples) : samples_(samples) {}
  TransmittanceEstimate estimate(const Medium&, const Ray&, const Interval&, Rng&) const override;

 private:
  float samples_;  // times as many in a comb as the paper has
};

class RayMarchedTransmittance final : public TransmittanceEstimator {
 public:
  explicit RayMarchedTransmittance(float step) : step_(step) {}
  TransmittanceEstimate estimate(const Medium&, const Ray&, const Interval&, Rng&) const override;

 private:
  float step_;  // in voxels
};

class JackknifeTransmittance final : public TransmittanceEstimator {
 public:
  explicit JackknifeTransmittance(float step) : step_(step) {}
  TransmittanceEstimate estimate(const Medium&, const Ray&, const Interval&, Rng&) const override;

 private:
  float step_;  // in voxels
};

}  // namespace vpm
