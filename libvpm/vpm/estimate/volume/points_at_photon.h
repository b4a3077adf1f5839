// The volumetric radiance estimate with the density at the photon, among the photons of the medium that the ray is in,
// also where its density is 0 [Jarosz2008, eq. 7.10, corrected].
#pragma once

#include "vpm/estimate/volume/volume_maps.h"

namespace vpm {

/// Marches evenly among the photons.
class PointsAtPhoton final : public VolumeEstimator {
 public:
  /// The gather is around points.
  PointsAtPhoton(const Scene& scene, const VolumeMapSettings& settings) : maps_(scene, settings, 3) {}

  ScatteredLight finds() const override { return maps_.finds(); }
  std::vector<MapInfo> maps() const override { return maps_.maps(); }
  Recorders recorders() override { return maps_.recorders(); }
  void build(uint64_t emitted, RenderStatistics& statistics) override;
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;

 private:
  VolumeMaps<PhotonMap> maps_;
};

}  // namespace vpm
