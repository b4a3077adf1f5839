// `ray-march`: quadrature of the optical thickness in equal steps with one random offset. Biased: the exponential of an
// unbiased column is not an unbiased transmittance; the bias falls as step^2.
#include "medium/transmittance/estimators.h"

namespace vpm {

TransmittanceEstimate RayMarchedTransmittance::estimate(const Medium& medium, const Ray& ray, const Interval& interval,
                                                        Rng& rng) const {
  TransmittanceEstimate result;
  const Interval inside = medium.clip(ray, interval);
  if (inside.empty()) return result;
  const double steps = std::isinf(medium.voxel_size())
                           ? 1.0
                           : std::ceil(inside.length() / (step_ * static_cast<double>(medium.voxel_size())));
  const double length = inside.length() / steps;
  const double offset = rng.uniform();
  double sum = 0.0;
  for (double i = 0.0; i < steps; ++i)
    sum += medium.density(ray.at(static_cast<float>(inside.t0 + (i + offset) * length)));
  result.lookups = static_cast<uint32_t>(steps);
  result.value = transmittance(medium, sum * length);
  return result;
}

}  // namespace vpm
