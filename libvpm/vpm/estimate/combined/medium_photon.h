// A photon in a medium, for merges, and kBlock of them side by side.
#pragma once

#include "vpm/estimate/combined/mis_weights.h"
#include "vpm/estimate/combined/vertex_map.h"

namespace vpm {

/// One that collided or, where a grid is thin, flew past (thin_places.h).
struct MediumPhoton {
  Vec3 travel{0.0f};  // unit
  Rgb power{0.0f};    // W over the density relative to the medium's largest, see stored_power()
  Vec3d turn{0.0};    // SubPathSums::turn
  // As they would be where the density is 1:
  OverColliding arrived;  // of the leg that led there
  BehindMerge behind;     // in maps times behind_scale()
};

/// Makes BehindMerge a number without a unit, by the density of points-2d in a medium of that extinction at density 1,
/// 1/m, a mean over channels: a float has room for it, however large a scene is.
inline double behind_scale(const TechniqueCounts& counts, double sigma_t) {
  return counts.points_2d > 0.0 && sigma_t > 0.0 ? counts.weigh(sigma_t / counts.points_2d) : 1.0;
}

/// Each member of kBlock photons in a row of its own, so that loops over rows are vector loops.
struct alignas(64) MediumPhotonLeaf : LeafPlaces {
  using Record = MediumPhoton;

  void set(size_t i, const MediumPhoton& photon) {
    travel_x[i] = photon.travel.x;
    travel_y[i] = photon.travel.y;
    travel_z[i] = photon.travel.z;
    power_r[i] = photon.power.r;
    power_g[i] = photon.power.g;
    power_b[i] = photon.power.b;
    turn_x[i] = static_cast<float>(photon.turn.x);
    turn_y[i] = static_cast<float>(photon.turn.y);
    turn_z[i] = static_cast<float>(photon.turn.z);
    passing[i] = finite_density(photon.arrived.passing);
    sent[i] = finite_density(photon.arrived.sent);
    adjacent[i] = finite_density(photon.behind.adjacent);
    further[i] = finite_density(photon.behind.further);
  }
  MediumPhoton operator[](size_t i) const {
    return {travel(i), power(i), Vec3d(turn(i)), {passing[i], sent[i]}, {adjacent[i], further[i]}};
  }
  Vec3 travel(size_t i) const { return {travel_x[i], travel_y[i], travel_z[i]}; }
  Vec3 turn(size_t i) const { return {turn_x[i], turn_y[i], turn_z[i]}; }
  Rgb power(size_t i) const { return {power_r[i], power_g[i], power_b[i]}; }

  float travel_x[kBlock], travel_y[kBlock], travel_z[kBlock];
  float power_r[kBlock], power_g[kBlock], power_b[kBlock];
  float turn_x[kBlock], turn_y[kBlock], turn_z[kBlock];
  float passing[kBlock], sent[kBlock], adjacent[kBlock], further[kBlock];
};

}  // namespace vpm
