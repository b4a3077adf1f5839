// Irradiance in vacuum: from lights without obstacles, and in closed diffuse cavities.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "vpm/base/statistics/moments.h"
#include "vpm/light/light.h"

namespace vpm {

/// Irradiance on the upper side of the plane z = 0 at a point, W/m^2, by direct light sampling. A sample is a sample of
/// the light.
Moments estimate_irradiance(const Light& light, const Vec3& receiver, uint64_t samples, uint64_t seed);
/// The same for a light drawn anew for each sample: one that is the mean of simpler ones.
Moments estimate_mean_irradiance(const std::function<Light(Rng&)>& draw, const Vec3& receiver, uint64_t samples,
                                 uint64_t seed);

/// The same, estimated by surface photon maps of the radii h and h/2. They are combined so that the h^2 term of their
/// bias cancels. A sample is a batch of photons. `fewest` is the number of photons within h/2, on average. Aimed:
/// photons are emitted in directions that importons from a camera above the receiver show, so that many more come near
/// it.
struct MappedIrradiance {
  Moments unbiased;
  double fewest = 0.0;
};
MappedIrradiance estimate_mapped_irradiance(const Light& light, const Vec3& receiver, double h, bool aimed,
                                            uint64_t photons, uint64_t seed);

/// A closed cavity with diffuse walls and a point source of 1 W inside.
struct Cavity {
  bool box = false;   // a cube with edge 2 size; else a sphere of radius size
  double size = 1.0;  // m
  double reflectance = 0.5;
  Vec3 source{0.0f};  // m
};

/// How often a photon hits the walls. A sample is a photon.
Moments estimate_wall_hits(const Cavity& cavity, uint64_t photons, uint64_t seed);
/// The fraction of uniform light from the walls of a sphere of radius R that the radiance estimate over the radius r
/// misses there, divided by (r/R)^2. The part of the sphere within the distance r has the area pi r^2 of a flat disc.
/// At distance d, however, the wall is tilted by theta: of the light that the walls send uniformly to that part, the
/// fraction (1 - cos theta)/2 = d^2 / (4 R^2) comes from behind the point and is left out. Averaged with the
/// Epanechnikov kernel, that is r^2 / (12 R^2).
inline constexpr double kCapLoss = 1.0 / 12.0;
/// The radius of estimate_wall_irradiance(), over the sphere's.
inline constexpr double kCapRadius = 0.1;
/// The mean irradiance, W/m^2, that a surface photon map shows over the walls of a sphere: of all photons, or of those
/// that have been reflected. Of the latter it misses kCapLoss kCapRadius^2. A sample is a batch.
Moments estimate_wall_irradiance(const Cavity& sphere, bool reflected_only, uint64_t photons, uint64_t seed);
/// Irradiance at a point of a sphere's wall straight from the source, W/m^2.
double direct_wall_irradiance(const Cavity& sphere, const Vec3& outward);
/// Radiance that the path tracer sees from a point inside: in all directions alike, or towards a wall point of that
/// normal.
Moments estimate_cavity_radiance(const Cavity& cavity, const Vec3* outward, uint64_t samples, uint64_t seed);

}  // namespace vpm
