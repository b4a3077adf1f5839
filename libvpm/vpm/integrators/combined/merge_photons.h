// Photons for merges, and kBlock of them side by side; those of a leaf around a place on a surface, or near rays.
#pragma once

#include "vpm/base/floats.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/integrators/combined/mis_weights.h"
#include "vpm/photon/map/ray_bundle.h"

namespace vpm {

/// A photon on a surface; or in a medium: one that collided or, where a grid is thin, flew past (thin_places.h).
struct MergePhoton {
  Vec3 point{0.0f};      // m
  Vec3 travel{0.0f};     // unit
  Rgb power{0.0f};       // W; in a medium over the density relative to its largest, see stored_power()
  Behind behind{};       // on a surface over merges_on_surface(); in a medium as it would be where the density is 1, in
                         // maps times behind_scale()
  double passing = 0.0;  // in a medium: of the leg that led there, m, likewise
};

/// Makes Behind a number without a unit, by the density of points-2d in a medium of that extinction at density 1,
/// 1/m, a mean over channels: a float has room for it, however large a scene is.
inline double behind_scale(const TechniqueCounts& counts, double sigma_t) {
  return counts.points_2d > 0.0 && sigma_t > 0.0 ? counts.weigh(sigma_t / counts.points_2d) : 1.0;
}

/// kBlock photons, each member in a row of its own, so that loops over rows are vector loops. Photons that it lacks are
/// infinitely far.
struct alignas(64) PhotonLeaf {
  void set(size_t i, const MergePhoton& photon) {
    set(i, photon.point, x, y, z);
    set(i, photon.travel, travel_x, travel_y, travel_z);
    set(i, photon.power, power_r, power_g, power_b);
    passing[i] = finite_density(photon.passing);
    adjacent[i] = finite_density(photon.behind.adjacent);
    further[i] = finite_density(photon.behind.further);
  }
  MergePhoton operator[](size_t i) const {
    return {point(i), travel(i), power(i), {adjacent[i], further[i]}, passing[i]};
  }
  Vec3 point(size_t i) const { return {x[i], y[i], z[i]}; }
  Vec3 travel(size_t i) const { return {travel_x[i], travel_y[i], travel_z[i]}; }
  Rgb power(size_t i) const { return {power_r[i], power_g[i], power_b[i]}; }

  float x[kBlock], y[kBlock], z[kBlock];
  float travel_x[kBlock], travel_y[kBlock], travel_z[kBlock];
  float power_r[kBlock], power_g[kBlock], power_b[kBlock];
  float passing[kBlock], adjacent[kBlock], further[kBlock];

 private:
  static void set(size_t i, const Vec3& value, float* x, float* y, float* z) {
    x[i] = value.x;
    y[i] = value.y;
    z[i] = value.z;
  }
};

/// The photons of a leaf around a place on a surface.
struct AroundPlace {
  LaneMask arrived;  // do they arrive within the radius, on that side of the surface?
  Floats q;          // their squared distance over that of the radius
  Floats cosine;     // of their directions to the normal
};
inline AroundPlace around(const PhotonLeaf& leaf, const Vec3& place, const Arrives& arrives, float radius) {
  const Floats3 offset = Floats3::of(leaf.x, leaf.y, leaf.z) - place;
  const Floats distance2 = dot(offset, offset), height = abs(dot(arrives.normal, offset));
  const Floats3 travel = Floats3::of(leaf.travel_x, leaf.travel_y, leaf.travel_z);
  const Floats cosine = Floats{} - dot(arrives.normal, travel);
  const LaneMask near = distance2 < radius * radius;
  const Floats reached = select(near, distance2, 0.0f);
  return {near & (cosine > 0.0f) & (height <= arrives.thickness + kSlope * sqrt(reached)),
          reached * (1.0f / (radius * radius)), cosine};
}

/// Finds the photons of a leaf that may be nearer to rays of the bundle than the radius, m: their numbers, for which
/// there is to be room for kBlock. Returns how many there are.
inline uint32_t find_near(const PhotonLeaf& leaf, const RayBundle& bundle, float radius, uint32_t* numbers) {
  const HalfSpaces& region = bundle.region();
  const float reach = 1.0001f * radius;  // for rounding
  const Floats3 places = Floats3::of(leaf.x, leaf.y, leaf.z) - bundle.apex();
  LaneMask near = -1;
  for (int k = 0; k < region.count(); ++k) near &= dot(region.normal(k), places) >= region.offset(k) - reach;
  return store_numbers(0, bits_of(near), numbers);
}

}  // namespace vpm
