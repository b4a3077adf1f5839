// The part of a disc on a surface that belongs to a point: what of the surface is really there, this side of walls.
#pragma once

#include "vpm/estimate/bounded_map.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// The places within reach of a point of a surface that lie near its plane (as in Arrives) on surfaces that photons are
/// stored on, inclined to it by less than 45 degrees, and that nothing stands before as seen along the surface: from a
/// tenth of the way above it, or from half as high as the first thing above the point where that is lower. Photons of
/// walls and of sides of steps do not count, nor those behind a wall; holes and what lies beyond an edge is no part of
/// the disc. As in Arrives itself, surfaces that bend with a radius above twice
/// the disc's are all there.
///
/// What the disc covers is asked of the scene, as by [Hey2002], not guessed from where photons are, as by their convex
/// hull [Jensen2001, ch. 7]. Its share of a kernel is found along 32 fixed lines from the point, at three places and
/// where there is a change between two of them; along 8 where these find nothing but the region. Off by 0.3 % of the
/// whole near edges and corners of right angles (root mean square over places and orientations), at most by 2 %. What
/// is narrower than a third of the radius, or than the angle between lines, may be missed.
class SurfaceRegion {
 public:
  /// Of the side of the hit that is seen from the direction `towards` (unit).
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

}  // namespace vpm
