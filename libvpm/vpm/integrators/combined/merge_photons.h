// Photons in media and on surfaces, for merges, and kBlock of them side by side; those of a leaf around a place on a
// surface.
#pragma once

#include "vpm/base/floats.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/integrators/combined/mis_weights.h"
#include "vpm/integrators/combined/vertex_map.h"

namespace vpm {

/// A photon in a medium: one that collided or, where a grid is thin, flew past (thin_places.h).
struct MediumPhoton {
  Vec3 travel{0.0f};  // unit
  Rgb power{0.0f};    // W over the density relative to the medium's largest, see stored_power()
  // As they would be where the density is 1:
  double passing = 0.0;  // of the leg that led there, m
  BehindMerge behind;    // in maps times behind_scale()
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
    passing[i] = finite_density(photon.passing);
    adjacent[i] = finite_density(photon.behind.adjacent);
    further[i] = finite_density(photon.behind.further);
  }
  MediumPhoton operator[](size_t i) const { return {travel(i), power(i), passing[i], {adjacent[i], further[i]}}; }
  Vec3 travel(size_t i) const { return {travel_x[i], travel_y[i], travel_z[i]}; }
  Rgb power(size_t i) const { return {power_r[i], power_g[i], power_b[i]}; }

  float travel_x[kBlock], travel_y[kBlock], travel_z[kBlock];
  float power_r[kBlock], power_g[kBlock], power_b[kBlock];
  float passing[kBlock], adjacent[kBlock], further[kBlock];
};

/// A photon on a surface.
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

/// The photons of a leaf around a place on a surface.
struct AroundPlace {
  LaneMask arrived;  // do they arrive within the radius, on that side of the surface?
  Floats q;          // their squared distance over that of the radius
  Floats cosine;     // of their directions to the normal
};
inline AroundPlace around(const SurfacePhotonLeaf& leaf, const Vec3& place, const Arrives& arrives, float radius) {
  const Floats3 offset = Floats3::of(leaf.x, leaf.y, leaf.z) - place;
  const Floats distance2 = dot(offset, offset), height = abs(dot(arrives.normal, offset));
  const Floats3 travel = Floats3::of(leaf.travel_x, leaf.travel_y, leaf.travel_z);
  const Floats cosine = Floats{} - dot(arrives.normal, travel);
  const LaneMask near = distance2 < radius * radius;
  const Floats reached = select(near, distance2, 0.0f);
  return {near & (cosine > 0.0f) & (height <= arrives.thickness + kSlope * sqrt(reached)),
          reached * (1.0f / (radius * radius)), cosine};
}

}  // namespace vpm
