// The list of transmittance estimators.
#include "medium/transmittance/estimator.h"

#include <array>

#include "medium/transmittance/estimators.h"

namespace vpm {

std::span<const EstimatorInfo> transmittance_estimators() {
  static constexpr std::array<EstimatorInfo, 2> kEstimators{{
      {"regular", "exact: the column of every cell along the ray"},
      {"ray-march", "quadrature in equal steps with one random offset; bias falls as step^2"},
  }};
  return kEstimators;
}

std::unique_ptr<TransmittanceEstimator> make_transmittance_estimator(const TransmittanceSettings& settings) {
  if (settings.estimator == "regular") return std::make_unique<RegularTransmittance>();
  if (settings.estimator == "ray-march") return std::make_unique<RayMarchedTransmittance>(settings.step);
  return nullptr;
}

}  // namespace vpm
