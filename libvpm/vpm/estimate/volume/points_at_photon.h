// The volumetric radiance estimate with the density at the photon: photons of any medium count wherever they lie within
// the radius of the ray, also where the ray itself is in empty space or outside the medium [Jarosz2008, eq. 7.10,
// corrected].
#pragma once

#include "vpm/estimate/volume/volume_maps.h"

namespace vpm {

/// Marches evenly among the photons of each medium.
class PointsAtPhoton final : public VolumeEstimator {
 public:
  /// The gather is around points, and does not correct borders.
  PointsAtPhoton(const Scene& scene, const VolumeMapSettings& settings) : scene_(scene), maps_(scene, settings, 3) {}

  ScatteredLight finds() const override { return maps_.finds(); }
  std::vector<MapInfo> maps() const override { return maps_.maps(); }
  Recorders recorders() override { return maps_.recorders(); }
  void build(uint64_t emitted, RenderStatistics& statistics) override;
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;

 private:
  const Scene& scene_;
  VolumeMaps<PhotonMap> maps_;
};

}  // namespace vpm
