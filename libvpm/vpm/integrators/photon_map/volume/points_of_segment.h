// Sums over the photons around points of a segment of an eye ray, by any rule of what is done at borders.
#pragma once

#include <optional>

#include "vpm/estimate/segment_region.h"
#include "vpm/integrators/photon_map/volume/volume_maps.h"

namespace vpm {

/// Builds maps of photons that are gathered around points.
void build_around_points(VolumeMaps<PhotonMap>& maps, uint64_t emitted, RenderStatistics& statistics);

/// Of the photons of the segment's medium.
class PointsOfSegment {
 public:
  /// The segment and the map outlive this. Points lie where photons may be: `around`, the box around those of the pass.
  PointsOfSegment(const EyeSegment& segment, const PhotonMap& map, const Box& around, VolumeForm form);

  /// The part of the ray at whose points photons are near, m. It goes past the segment's ends where photons there make
  /// up for what is missing before them.
  const Interval& reach() const { return reach_; }
  /// See SegmentRegion.
  Mirrored mirrored() const { return region_.mirrored(); }
  /// Has each photon its own transmittance, as beside a ray? Then march_evenly() is for these points.
  bool seen_one_by_one() const { return spread_ == Spread::balls_as_discs; }
  /// volume_sum() around a point, towards the eye.
  KernelEstimate sum(const Vec3& point, EyeWork& work) const;
  /// The sum over points in even steps through the reach, each attenuated: throughput and albedo are left out.
  KernelEstimate march_evenly(EyeWork& work) const;
  /// The light of the segment, corrected where its region is not whole.
  KernelEstimate over_share(const KernelEstimate& light, EyeWork& work) const;

 private:
  KernelEstimate sum_of_seen(const Vec3& point, EyeWork& work) const;
  KernelEstimate march_seen(EyeWork& work) const;

  const EyeSegment& segment_;
  const PhotonMap& map_;
  VolumeForm form_;
  Spread spread_;
  SegmentRegion region_;
  Interval reach_;  // m
};

}  // namespace vpm
