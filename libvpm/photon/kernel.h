// Density estimation kernels in two and three dimensions, normalised over the unit ball.
#pragma once

#include "base/vec.h"

namespace vpm {

enum class KernelKind { constant, epanechnikov, biweight };

/// The kernels' profiles in q = (distance / radius)^2, q <= 1, without their normalisation: (1 - q)^n.
template <KernelKind K>
float kernel_profile(float q) {
  if constexpr (K == KernelKind::constant) return 1.0f;
  if constexpr (K == KernelKind::epanechnikov) return 1.0f - q;
  if constexpr (K == KernelKind::biweight) return (1.0f - q) * (1.0f - q);
}

/// What the profile is multiplied by for its integral over the ball of radius r to be 1: 1/m^2 or 1/m^3 [Silverman1986,
/// sec. 4.2].
inline float kernel_norm_2d(KernelKind kind, float r) {
  const float n = kind == KernelKind::constant ? 1.0f : kind == KernelKind::epanechnikov ? 2.0f : 3.0f;
  return n / (kPi * r * r);
}
inline float kernel_norm_3d(KernelKind kind, float r) {
  const float n = kind == KernelKind::constant ? 0.75f : kind == KernelKind::epanechnikov ? 1.875f : 3.28125f;
  return n / (kPi * r * r * r);
}

}  // namespace vpm
