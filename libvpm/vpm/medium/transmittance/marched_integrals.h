// Density integrals by samples along the ray: what the marching estimators share.
#pragma once

#include <optional>

#include "vpm/base/cancel.h"
#include "vpm/medium/transmittance/estimator.h"

namespace vpm {

/// The transmittance where no sample is needed: of a stretch without density, and of an endless one, which is opaque.
/// `inside` is what Medium::clip() leaves of the interval.
inline std::optional<TransmittanceEstimate> known_transmittance(const Medium& medium, const Interval& inside) {
  if (inside.empty()) return TransmittanceEstimate{};
  if (std::isinf(inside.t1)) return TransmittanceEstimate{transmittance(medium, inside.t1), 0};
  return std::nullopt;
}

/// Steps of `step` voxels at the most over a finite stretch; one in a homogeneous medium.
inline double step_count(const Medium& medium, const Interval& inside, float step) {
  if (std::isinf(medium.voxel_size())) return 1.0;
  return std::ceil(inside.length() / (step * static_cast<double>(medium.voxel_size())));
}

/// The density integral of a stretch, m, by one density from each of `count` equal steps, all at the share `offset` of
/// their step. Its mean over uniform offsets in [0, 1) is the density integral.
inline double comb_integral(const Medium& medium, const Ray& ray, const Interval& inside, double count, double offset) {
  const double length = inside.length() / count;
  const DensityAlong along = medium.density_along(ray);
  float densities[DensityAlong::kAtOnce];
  double sum = 0.0;
  for (double i = 0.0; i < count; i += DensityAlong::kAtOnce) {
    cancellation_point();
    const auto here = static_cast<size_t>(std::min(count - i, double{DensityAlong::kAtOnce}));
    along.at(inside.t0 + (i + offset) * length, length, {densities, here});
    for (size_t k = 0; k < here; ++k) sum += densities[k];
  }
  return sum * length;
}

}  // namespace vpm
