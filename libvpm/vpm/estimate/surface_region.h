// The part of a disc on a surface that belongs to a point: where the surface really is, on this side of walls.
#pragma once

#include "vpm/estimate/bounded_map.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// The places within reach of a point of a surface that meet three conditions. They lie near its plane (as in Arrives).
/// They are on surfaces that store photons and are inclined to the plane by less than 45 degrees. Nothing stands before
/// them on a line of sight above the surface, whose height is a tenth of the distance, or half the height of the first
/// surface above the point where that is lower. So photons on walls, on the sides of steps and behind walls do not
/// count; holes and what lies beyond an edge are no part of the disc. As in Arrives, curved surfaces whose radius of
/// curvature is above twice the disc's radius belong to the region completely.
///
/// The scene is asked what the disc covers, as in [Hey2002]; it is not guessed from the photons' positions, as by their
/// convex hull [Jensen2001, ch. 7]. The region's share of a kernel is found along 32 fixed lines from the point. Each
/// line is tested at three places, and the change is located where two of them differ. If the first 8 lines find
/// nothing but the region, they are enough. The error is 0.3 % of the whole kernel near edges and right-angled corners
/// (root mean square over places and orientations), at most 2 %. What is narrower than a third of the radius, or than
/// the angle between lines, may be missed.
class SurfaceRegion {
 public:
  /// The region on the side of the hit that is seen from the direction `towards` (unit).
  SurfaceRegion(const Scene& scene, const Hit& hit, const Vec3& towards, const GatherSettings& gather);

  RegionShare share(float radius) const;
  bool holds(const Vec3& offset) const;

 private:
  float lift(float distance) const;
  bool covers(const Vec3& across) const;
  bool sees(const Vec3& offset) const;
  bool counts(const Hit& hit) const;

  const Scene& scene_;
  Vec3 point_;
  Vec3 start_;  // the point, just off the surface
  Arrives near_;
  float free_ = kInfinity;  // m, from the point up to the first surface above it
  KernelKind kernel_;
};

// As those of surface_estimate.h.
extern template KernelEstimate surface_irradiance(const Vec3&, const Vec3&, const BoundedMap<SurfaceRegion>&);
extern template KernelEstimate scattered_radiance(const Material&, const Hit&, const Vec3&,
                                                  const BoundedMap<SurfaceRegion>&);

}  // namespace vpm
