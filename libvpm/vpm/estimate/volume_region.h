// The part of a ball in a medium that belongs to a point: what can be seen from the point.
#pragma once

#include <vector>

#include "vpm/estimate/bounded_map.h"
#include "vpm/estimate/volume_estimate.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// The places of a medium within reach of a point where the density is not zero and which the point sees: no surface
/// and no border of a medium lies between. So light does not leak into the region through thin walls, and the part of
/// the ball outside the medium does not count.
///
/// The region's share of a kernel is found by rays into 128 fixed directions, or into 512 where it is less than 0.6. In
/// homogeneous media it is exact along each ray. Its error, as a part of the whole kernel, is 0.3 % near faces and
/// 0.4 % near right-angled corners (root mean square over places and orientations), at most 2.3 %. Exactly at such a
/// corner it is 0.1 % where the faces are perpendicular to the axes; otherwise it is 0.3 %, at most 1.2 %. Between two
/// walls it is 1 % of the share itself. No ray is sent where no shape is within the radius and the density is positive
/// in the bricks around the point.
class VolumeRegion {
 public:
  /// With the density at the photon, places without density are of the region, too: the estimate is that of collisions.
  VolumeRegion(const Scene& scene, MediumId medium, const Vec3& point, KernelKind kernel,
               VolumeForm form = VolumeForm::density_at_query)
      : scene_(scene), medium_(medium), point_(point), kernel_(kernel), form_(form) {}

  RegionShare share(float radius) const;
  bool holds(const Vec3& offset) const;

 private:
  RegionShare share_along(const std::vector<Vec3>& half_sphere, float radius, bool filled) const;
  bool is_filled(float radius) const;
  bool comes_again(const Hit& border, const Vec3& direction, float rest) const;

  const Scene& scene_;
  MediumId medium_;  // not kVacuum
  Vec3 point_;
  KernelKind kernel_;
  VolumeForm form_;
};

// As those of volume_estimate.h.
extern template KernelEstimate volume_sum(const Phase&, const Vec3&, const Vec3&, const BoundedMap<VolumeRegion>&);
extern template Rgb fluence(const Rgb&, const Vec3&, const BoundedMap<VolumeRegion>&);

}  // namespace vpm
