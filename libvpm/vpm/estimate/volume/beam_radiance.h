// The beam radiance estimate [Jarosz2008beam]: all photons near a segment of the eye ray, by one query of each map.
#pragma once

#include <span>

#include "vpm/estimate/beam_estimate.h"
#include "vpm/estimate/segment_region.h"
#include "vpm/estimate/volume/volume_maps.h"

namespace vpm {

/// Gathers photons of the medium that the segment is in, over discs perpendicular to the ray.
class BeamRadiance final : public VolumeEstimator {
 public:
  BeamRadiance(const Scene& scene, const VolumeMapSettings& settings) : maps_(scene, settings, 2) {}

  ScatteredLight finds() const override { return maps_.finds(); }
  std::vector<MapInfo> maps() const override { return maps_.maps(); }
  Recorders recorders() override { return maps_.recorders(); }
  void build(uint64_t emitted, RenderStatistics& statistics) override;
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;

 private:
  KernelEstimate gather(const EyeSegment& segment, const SegmentRegion& region, const Interval& near,
                        EyeWork& work) const;

  VolumeMaps<BeamMap> maps_;
};

}  // namespace vpm
