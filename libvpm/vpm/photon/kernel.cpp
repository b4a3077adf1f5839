// Integrals of kernels known at run time.
#include "vpm/photon/kernel.h"

#include <algorithm>

namespace vpm {
namespace {

/// kernel_profile() of a kernel known at run time.
double kernel_profile_of(KernelKind kind, int dimension, double q) {
  const double rest = 1.0 - q;
  switch (kind) {
    case KernelKind::constant:
      return 1.0;
    case KernelKind::cone:
      return 1.0 - std::sqrt(q);
    case KernelKind::epanechnikov:
      return rest;
    case KernelKind::biweight:
      return rest * rest;
    case KernelKind::triweight:
      return rest * rest * rest;
    case KernelKind::order_4:
      break;
  }
  return rest * (1.0 - (dimension + 6.0) / (dimension + 2.0) * q);
}

}  // namespace

KernelPair<double> kernel_within(KernelKind kind, int dimension, double t) {
  const auto within = [&](double s) {
    if (dimension == 1) return kernel_within_1d(kind, s);
    return dimension == 2 ? kernel_within_2d(kind, s) : kernel_within_3d(kind, s);
  };
  if (kind == KernelKind::constant) return {within(t), 2.0 * (within(std::min(1.0, std::sqrt(2.0) * t)) - within(t))};
  const KernelInfo& info = kernel_info(kind);
  const double measure = dimension == 1   ? info.line * t
                         : dimension == 2 ? info.disc * t * t
                                          : 2.0 * info.ball * t * t * t;
  return {within(t), measure * kernel_profile_of(kind, dimension, t * t)};
}

}  // namespace vpm
