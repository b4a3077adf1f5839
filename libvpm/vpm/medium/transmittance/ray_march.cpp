// `ray-march`: quadrature of the optical thickness in equal steps with one random offset. Biased: the exponential of an
// unbiased density integral is not an unbiased transmittance; the bias falls as step^2.
#include "vpm/medium/transmittance/estimators.h"
#include "vpm/medium/transmittance/marched_integrals.h"

namespace vpm {

TransmittanceEstimate RayMarchedTransmittance::estimate(const Medium& medium, const Ray& ray, const Interval& interval,
                                                        Rng& rng) const {
  const Interval inside = medium.clip(ray, interval);
  if (const auto known = known_transmittance(medium, inside)) return *known;
  const double steps = step_count(medium, inside, step_);
  const double integral = comb_integral(medium, ray, inside, steps, rng.uniform());
  return {transmittance(medium, integral), static_cast<uint32_t>(steps)};
}

}  // namespace vpm
