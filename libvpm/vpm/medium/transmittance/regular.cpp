// `regular`: exact transmittance, from the exact density integral of the cells along the ray [Novak2018, sec. 4.1].
#include "vpm/medium/transmittance/estimators.h"

namespace vpm {

TransmittanceEstimate RegularTransmittance::estimate(const Medium& medium, const Ray& ray, const Interval& interval,
                                                     Rng&) const {
  const DensityIntegral crossed = density_integral(medium, ray, interval);
  return {transmittance(medium, crossed.value), crossed.lookups};
}

}  // namespace vpm
