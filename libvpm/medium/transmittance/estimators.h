// The classes behind the names of the transmittance estimators.
#pragma once

#include "medium/transmittance/estimator.h"

namespace vpm {

class RegularTransmittance final : public TransmittanceEstimator {
 public:
  TransmittanceEstimate estimate(const Medium&, const Ray&, const Interval&, Rng&) const override;
};

class RayMarchedTransmittance final : public TransmittanceEstimator {
 public:
  explicit RayMarchedTransmittance(float step) : step_(step) {}
  TransmittanceEstimate estimate(const Medium&, const Ray&, const Interval&, Rng&) const override;

 private:
  float step_;  // in voxels
};

}  // namespace vpm
