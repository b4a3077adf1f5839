// What is known of density estimates from photons that lie uniformly in the unit interval, square or cube: means,
// variances, bias.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vpm/base/statistics/moments.h"
#include "vpm/photon/kernel.h"

namespace vpm {

/// Estimates of a density of 1 at one point, by each of kKernels. A sample is a map.
struct DensityFacts {
  std::array<Moments, kKernels.size()> mean, square_error;  // square error: (estimate - 1)^2
  std::array<Moments, kKernels.size()>
      square_ratio;             // (estimate / that of the constant kernel)^2, at most the kernel's peak^2
  std::vector<double> volumes;  // of the ball, disc or stretch of the estimate
};

/// By the k nearest of `photons` photons, in `dimension` 1, 2 or 3. The ball's volume is the one whose k - 1 photons
/// give the constant kernel's estimate.
DensityFacts estimate_nearest_density(int dimension, uint64_t photons, uint32_t k, uint64_t maps, uint64_t seed);

/// By all photons within a radius.
DensityFacts estimate_radius_density(int dimension, uint64_t photons, double radius, uint64_t maps, uint64_t seed);

/// The mean estimate at x = 0 of the densities 1 + x_1, 1 + |x|^2, 1 + cos(x_1/h), 1 + cos(2 x_1/h), 1 + cos(4 x_1/h),
/// in that order, through a map of radius h. The photons form a lattice shifted at random, with powers as the density
/// is: the mean is exact as for random photons, the noise far smaller. A sample is a shift.
inline constexpr size_t kBiasDensities = 5;
std::array<Moments, kBiasDensities> estimate_kernel_bias(int dimension, KernelKind kernel, double h, uint64_t shifts,
                                                         uint64_t seed);

/// Integrals over the unit ball of the library's kernel profile, by quadrature; dimension 1, 2 or 3.
struct KernelIntegrals {
  double volume = 0.0;  // of the ball
  double profile = 0.0, square = 0.0;
  double second_moment = 0.0;      // of |x|^2 times the profile
  std::array<double, 3> cosine{};  // of cos(x_1), cos(2 x_1), cos(4 x_1) times the profile
};
KernelIntegrals integrate_kernel(int dimension, KernelKind kernel);

/// Probability that the ball around a point that holds its k nearest of n uniform photons has at most that volume.
double nearest_volume_below(double volume, uint32_t k, uint64_t n);

}  // namespace vpm
