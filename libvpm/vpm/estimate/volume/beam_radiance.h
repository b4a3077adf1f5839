// The beam radiance estimate [Jarosz2008beam]: all photons near a segment of the eye ray, by one query of each map.
#pragma once

#include <span>

#include "vpm/estimate/beam_estimate.h"
#include "vpm/estimate/volume/volume_maps.h"

namespace vpm {

/// With the density at the query, it gathers photons of the medium that the ray is in; with the density at the photon,
/// those of all media. The kernel is over discs perpendicular to the ray. Nothing is corrected at borders.
class BeamRadiance final : public VolumeEstimator {
 public:
  BeamRadiance(const Scene& scene, const VolumeMapSettings& settings) : scene_(scene), maps_(scene, settings, 2) {}

  ScatteredLight finds() const override { return maps_.finds(); }
  std::vector<MapInfo> maps() const override { return maps_.maps(); }
  Recorders recorders() override { return maps_.recorders(); }
  void build(uint64_t emitted, RenderStatistics& statistics) override;
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;

 private:
  KernelEstimate gather(const EyeSegment& segment, const Interval& near, size_t medium, EyeWork& work) const;

  const Scene& scene_;
  VolumeMaps<BeamMap> maps_;
};

}  // namespace vpm
