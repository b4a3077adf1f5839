// The list of transmittance estimators, and the exact one.
#include "vpm/medium/transmittance/estimator.h"

#include <algorithm>
#include <vector>

#include "vpm/base/settings/setting.h"

namespace vpm {
namespace {

class RegularTransmittance final : public TransmittanceEstimator {
 public:
  TransmittanceEstimate estimate(const Medium&, const Ray&, const Interval&, Rng&) const override;
};

// `regular`: exact transmittance, from the exact density integral of the cells along the ray [Novak2018, sec. 4.1].
TransmittanceEstimate RegularTransmittance::estimate(const Medium& medium, const Ray& ray, const Interval& interval,
                                                     Rng&) const {
  const DensityIntegral crossed = density_integral(medium, ray, interval);
  return {transmittance(medium, crossed.value), crossed.lookups};
}

}  // namespace

extern const EstimatorInfo kRegularTransmittance{
    .name = "regular",
    .summary = "exact: the density integral of every cell along the ray",
    .failure = "a step for every cell crossed, however thin the medium is there",
    .source = "Novak2018",
    .make = [](ParameterValues) -> std::unique_ptr<TransmittanceEstimator> {
      return std::make_unique<RegularTransmittance>();
    }};

extern const EstimatorInfo kRatio, kRatioLocal, kResidualRatio, kUnbiasedRayMarch, kRayMarchedTransmittance, kJackknife;

std::span<const EstimatorInfo> transmittance_estimators() {
  static const std::vector<EstimatorInfo> all{
      kRegularTransmittance,    kRatio,    kRatioLocal, kResidualRatio, kUnbiasedRayMarch,
      kRayMarchedTransmittance, kJackknife};
  return all;
}

std::unique_ptr<TransmittanceEstimator> make_transmittance_estimator(const TransmittanceSettings& settings) {
  for (const EstimatorInfo& info : transmittance_estimators())
    if (info.name == settings.estimator) return info.make(numbers_of(info.parameters, settings.parameters));
  return nullptr;
}

void describe(TransmittanceSettings& settings, Description& description) {
  const auto all = transmittance_estimators();
  Members(settings, description)
      .add("type", &TransmittanceSettings::estimator, Words{names_of(all)},
           "of shadow rays: `\"regular\"` is exact, `\"ray-march\"` and `\"jackknife\"` are biased, the others noisy "
           "and right on average: [papers/transmittance.md](../papers/transmittance.md)");
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const EstimatorInfo& info) { return info.name == settings.estimator; });
  if (found != all.end()) describe(found->parameters, settings.parameters, description);
}

}  // namespace vpm
