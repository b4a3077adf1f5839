// An isotropic point source of 1 W in an infinite homogeneous medium: collisions around it, and fluence through the
// volume photon map.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/base/statistics/moments.h"

namespace vpm {

/// All lengths are optical: distance times sigma_t. Fluences are those for sigma_t = 1/m; for others they are
/// proportional to its square.
struct PointSource {
  double albedo = 0.9;
  double g = 0.0;  // of Henyey and Greenstein's phase function
};

/// Photons wander for 1/(1 - albedo) collisions: for ever where nothing is absorbed. Above an albedo of 0.999 the
/// medium therefore ends at a sphere, and what the medium beyond it would send back is added: far from the source that
/// is the regular solution of diffusion, which vanishes with the source's own at the extrapolated end point [Case1953].
/// Its error, a bound, is added to the checks.
struct MissingLight {
  double end = 0.0;  // radius of the medium; 0: it has no end
  double fluence(double radius) const;
  double collisions_within(double radius) const;
  /// Bound of the relative error of both.
  double relative_error = 0.0;

  double diffusion = 1.0;  // coefficient
  double attenuation = 0.0;
  double extrapolated = 0.0;  // where the fluence vanishes
};
MissingLight missing_light(const PointSource& source, double largest_radius);

/// Collisions per photon within each of the radii of the source; a sample is a photon.
std::vector<Moments> estimate_collisions_within(const PointSource& source, const std::vector<double>& radii,
                                                uint64_t photons, uint64_t seed);

/// Photon maps: `batches` of `photons` each, sharing nothing.
struct MapEffort {
  int batches = 20;
  uint64_t photons = 0;
  uint64_t seed = 1;
};

/// The fluence at one distance through maps of two kernel radii, h and h/2, W/m^2; a sample is a batch. `unbiased` is
/// (4 fluence(h/2) - fluence(h)) / 3: the bias of a kernel estimate is even in h, so its h^2 goes.
struct MapFluence {
  Moments wide, narrow, unbiased;
  double fewest = 0.0;  // photons within h/2 of the sphere in a batch, on average
};
/// `collided_only`: of the photons that have scattered before. Kernel radii for each distance.
std::vector<MapFluence> estimate_map_fluence(const PointSource& source, const std::vector<double>& distances,
                                             const std::vector<double>& kernel_radii, bool collided_only,
                                             const MapEffort& effort);

/// The fluence of light that has not scattered, W/m^2, by direct light sampling.
double direct_fluence(const PointSource& source, double distance);

}  // namespace vpm
