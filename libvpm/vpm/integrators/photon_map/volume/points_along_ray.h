// The volumetric radiance estimate [Jarosz2008, eq. 7.10, corrected] at points along an eye ray, with the density at
// the photon.
#pragma once

#include "vpm/integrators/photon_map/volume/points_of_segment.h"

namespace vpm {

/// Marches evenly among the photons of the medium that the ray is in, also where its density is 0.
class PointsAtPhoton final : public VolumeEstimator {
 public:
  /// The gather is around points.
  PointsAtPhoton(const Scene& scene, const VolumeSettings& settings, const MediaPass& pass)
      : maps_(scene, settings, pass, 3) {}

  ScatteredLight finds() const override { return maps_.finds(); }
  std::vector<MapInfo> maps() const override { return maps_.maps(); }
  Recorders recorders() override { return maps_.recorders(); }
  void build(uint64_t emitted, RenderStatistics& statistics) override {
    build_around_points(maps_, emitted, statistics);
  }
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;
  float kernel_variance(MediumId medium) const override { return variance_of(maps_[medium].settings, 3); }

 private:
  VolumeMaps<PhotonMap> maps_;
};

}  // namespace vpm
