// Irradiance computed beforehand at places that photons found, for the many rays that end among them [Christensen1999].
//
// A ray that ends on a Lambertian surface takes the irradiance of the nearest point whose normal agrees, in place of a
// sum over all photons there: constant over the cell around each point. That is a bias beside the kernel's: it blurs
// light by the distance to the points, which is at most the map's radius, and vanishes with that radius.
//
// The photons that found the places are none of the map's, which differs from [Christensen1999]. An estimate at the
// place of one of its photons counts that one at the kernel's peak; and the nearest place being known, none of the
// others that are places lies nearer. Both errors go with the number of photons within the radius, which shrinking
// radii lower: where it falls below one a surface would look brighter by a quarter, however many passes there are.
#pragma once

#include <optional>

#include "vpm/estimate/photon_map.h"
#include "vpm/photon/records.h"
#include "vpm/surface/geometry.h"

namespace vpm {

/// Normals agree whose cosine is above this.
inline constexpr float kSameNormal = 0.9f;

class IrradiancePoints {
 public:
  IrradiancePoints() = default;
  /// Computes the irradiance of the map's photons at the sites, in parallel.
  IrradiancePoints(const std::vector<SurfaceSite>& sites, const PhotonMap& map, GatherCounters& counters);

  /// Irradiance by the cosines to the shading normal, W/m^2, on the side of a hit that `towards_eye` (unit) lies on:
  /// that of the nearest point there, within the map's radius. Nothing where there is none, or where `towards_eye` lies
  /// on different sides of the two normals.
  std::optional<Rgb> irradiance(const Hit& hit, const Vec3& towards_eye, GatherWork work) const;

  size_t size() const { return points_.size(); }
  size_t memory_bytes() const { return points_.memory_bytes(); }

 private:
  GatherSettings gather_;   // the one nearest point
  float thickness_ = 0.0f;  // m, plane_thickness() of the map
  NearestMap points_;       // as photons that fly against the shading normal, with the irradiance, W/m^2, for a power
};

}  // namespace vpm
