// Photons uniform in the unit cube, and places to look for them.
#pragma once

#include <vector>

#include "vpm/photon/photon.h"

namespace vpm::bench {

inline constexpr double kNeighbours = 50;

std::vector<Photon> random_photons(size_t count);
/// The radius of spheres that hold kNeighbours of them on average, m.
float neighbour_radius(size_t photons);
/// Uniform in the cube.
std::vector<Vec3> random_queries(size_t count);
/// In the order of their Morton codes: neighbours come one after another, as in a renderer's tiles.
std::vector<Vec3> morton_sorted(std::vector<Vec3> points);

}  // namespace vpm::bench
