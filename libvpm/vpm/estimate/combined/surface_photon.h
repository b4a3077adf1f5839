// A photon on a surface, for merges, and kBlock of them side by side.
#pragma once

#include "vpm/estimate/combined/mis_weights.h"
#include "vpm/estimate/combined/vertex_map.h"

namespace vpm {

struct SurfacePhoton {
  Vec3 point{0.0f};    // m
  Vec3 travel{0.0f};   // unit
  Rgb power{0.0f};     // W
  BehindMerge behind;  // over the density of merges on surfaces, MergeTerms::surface
};

/// Each member of kBlock photons in a row of its own, so that loops over rows are vector loops.
struct alignas(64) SurfacePhotonLeaf : LeafPlaces {
  using Record = SurfacePhoton;

  void set(size_t i, const SurfacePhoton& photon) {
    travel_x[i] = photon.travel.x;
    travel_y[i] = photon.travel.y;
    travel_z[i] = photon.travel.z;
    power_r[i] = photon.power.r;
    power_g[i] = photon.power.g;
    power_b[i] = photon.power.b;
    adjacent[i] = finite_density(photon.behind.adjacent);
    further[i] = finite_density(photon.behind.further);
  }
  SurfacePhoton operator[](size_t i) const {
    return {{x[i], y[i], z[i]},
            {travel_x[i], travel_y[i], travel_z[i]},
            {power_r[i], power_g[i], power_b[i]},
            {adjacent[i], further[i]}};
  }

  float travel_x[kBlock], travel_y[kBlock], travel_z[kBlock];
  float power_r[kBlock], power_g[kBlock], power_b[kBlock];
  float adjacent[kBlock], further[kBlock];
};

}  // namespace vpm
