// The irradiance cache: irradiance computed before the eye pass at points that photons found, for the many gathering
// rays that end near them [Christensen1999].
//
// A ray that ends on a Lambertian surface takes the irradiance of the nearest cache point whose normal agrees, instead
// of a sum over all photons there. The irradiance is therefore constant over the cell around each point. This adds a
// bias to that of the kernel: light is blurred by the distance to the points. That distance is at most the map's
// radius, so the bias vanishes with the radius.
//
// In [Christensen1999] the photons that find the cache points also belong to the map. Here they do not, for two
// reasons. An estimate at a photon's own position counts that photon at the kernel's peak. And once the nearest point
// is known, no other cache point lies nearer. Both errors grow as fewer photons lie within the radius, which is what
// shrinking radii cause: below one photon a surface would look brighter by a quarter, however many passes there are.
#pragma once

#include <optional>

#include "vpm/estimate/photon_map.h"
#include "vpm/photon/records.h"
#include "vpm/surface/geometry.h"

namespace vpm {

/// Normals agree whose cosine is above this.
inline constexpr float kSameNormal = 0.9f;

class IrradianceCache {
 public:
  IrradianceCache() = default;
  /// Computes the irradiance of the map's photons at the points, in parallel.
  IrradianceCache(const std::vector<CachePoint>& points, const PhotonMap& map, GatherCounters& counters);

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
