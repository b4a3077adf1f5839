// A homogeneous sphere in a uniform environment of radiance 1: what leaves it, the fluence inside, and its image.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/base/statistics/moments.h"

namespace vpm {

struct FoggySphere {
  double optical_radius = 1.0;
  double albedo = 1.0;
  double g = 0.0;  // of Henyey and Greenstein's phase function
};

/// A sample is a photon.
struct SpherePhotons {
  Moments entering;                       // power over that through the sphere's surface: of all photons emitted
  Moments escaped, absorbed, uncollided;  // shares of the photons that enter
  Moments collisions;                     // of a photon that enters
};
SpherePhotons estimate_sphere_photons(const FoggySphere& sphere, uint64_t photons, uint64_t seed);

/// A sample is a path of the path tracer to each place.
struct SpherePaths {
  std::vector<Moments> fluence;  // W/m^2
  std::vector<Moments> image;    // W/(m^2 sr)
};
/// Fluence at distances from the center, radiance along rays at impact parameters, both over the radius.
SpherePaths estimate_sphere_paths(const FoggySphere& sphere, const std::vector<double>& radii,
                                  const std::vector<double>& impacts, uint64_t samples, uint64_t seed);

}  // namespace vpm
