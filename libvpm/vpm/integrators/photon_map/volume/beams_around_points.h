// Photon beams around points of a march along the eye ray [Jarosz2011]: each flight of a photon is spread over discs
// across it. So there is no sine to divide by, as where beams meet the ray itself; but points must be many.
#pragma once

#include "vpm/estimate/segment_region.h"
#include "vpm/integrators/photon_map/volume/beam_maps.h"
#include "vpm/integrators/photon_map/volume/pass_to_eye.h"

namespace vpm {

/// Marches evenly among the beams of the medium that the segment is in. Each beam has the transmittance to the eye of
/// its place nearest to the point of the march.
///
/// Steps are no longer than the radius, so that few beams are passed by between two points, and have no more than
/// `max_optical_step` of optical thickness where the medium is densest, so that few of the short ones there are: that
/// is noise, and no bias. Where the radius reaches far beyond the beams, steps are as many as among these.
class BeamsAroundPoints final : public VolumeEstimator {
 public:
  BeamsAroundPoints(const Scene& scene, const VolumeSettings& settings, const MediaPass& pass, float max_optical_step)
      : beams_(scene, settings, pass, 2), max_optical_step_(max_optical_step) {}

  ScatteredLight finds() const override { return beams_.finds(); }
  std::vector<MapInfo> maps() const override { return beams_.maps(); }
  Recorders recorders() override { return {beams_.recorder()}; }
  void build(uint64_t emitted, RenderStatistics& statistics) override;
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;
  float kernel_variance(MediumId medium) const override { return variance_of(beams_[medium].settings, 2); }

 private:
  struct Map {
    GatherSettings settings;  // of this pass
    PhotonBeamMap beams;

    size_t memory_bytes() const { return beams.memory_bytes(); }
  };

  /// A segment, and what is gathered for it.
  struct Sight {
    const EyeSegment& segment;
    const SegmentRegion& region;
    const PassToEye& pass;
    const Map& map;
  };

  KernelEstimate march(const Sight& sight, const Interval& near, EyeWork& work) const;
  KernelEstimate sum(const Vec3& point, const Sight& sight, EyeWork& work) const;

  BeamMaps<Map> beams_;
  float max_optical_step_;
};

}  // namespace vpm
