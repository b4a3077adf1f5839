// The volumetric radiance estimate [Jarosz2008, eq. 7.10, corrected] at points of a march, with the density at the
// query.
#pragma once

#include "vpm/estimate/volume/marched.h"
#include "vpm/estimate/volume/volume_maps.h"

namespace vpm {

/// Photons around a point, by radius or by count.
class PointsAtQuery final : public MarchedSource {
 public:
  /// The gather is around points.
  PointsAtQuery(const Scene& scene, const VolumeMapSettings& settings) : maps_(scene, settings, 3) {}

  ScatteredLight finds() const override { return maps_.finds(); }
  std::vector<MapInfo> maps() const override { return maps_.maps(); }
  Recorders recorders() override { return maps_.recorders(); }
  void build(uint64_t emitted, RenderStatistics& statistics) override;
  Reach reach(const EyeSegment& segment) const override;
  KernelEstimate evenly(const EyeSegment& segment, const Reach& reach, EyeWork& work) const override;
  KernelEstimate at(const EyeSegment& segment, const Reach& reach, const Vec3& point, EyeWork& work) const override;

 private:
  VolumeMaps<PhotonMap> maps_;
};

}  // namespace vpm
