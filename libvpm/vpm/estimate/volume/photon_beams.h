// Photon beams met by eye rays [Jarosz2011]: all flights of photons that pass a segment of an eye ray closely. Each is
// spread over a kernel of one dimension, along the common perpendicular of the two lines.
#pragma once

#include "vpm/estimate/pass_map.h"
#include "vpm/estimate/segment_region.h"
#include "vpm/estimate/volume/estimator.h"
#include "vpm/photon/photon_beam_map.h"

namespace vpm {

struct PhotonBeamSettings {
  AskedGather gather;
  VolumeForm form = VolumeForm::density_at_query;
  bool once = true;      // also the beams of photons that come straight from lights
  uint64_t flights = 0;  // > 0: the most beams, of all media together
  uint64_t seed = 1;     // of which of them
  PassOfMaps pass;
};

/// Gathers the beams of the medium that the segment is in. A beam ends where its photon collides: the photon has come
/// as far as to a place on the beam with the probability of the transmittance to it, so that this needs no further
/// factor in a grey medium, whatever its density. In a chromatic one the weights of the mixture of channels are left.
class PhotonBeams final : public VolumeEstimator {
 public:
  PhotonBeams(const Scene& scene, const PhotonBeamSettings& settings);

  ScatteredLight finds() const override { return {settings_.once, true}; }
  std::vector<MapInfo> maps() const override { return {{.section = "volume", .dimension = 1}}; }
  Recorders recorders() override { return {&recorder_}; }
  void build(uint64_t emitted, RenderStatistics& statistics) override;
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;

 private:
  struct Map {
    GatherSettings settings;  // of this pass
    PhotonBeamMap beams;
  };

  KernelEstimate gather(const EyeSegment& segment, const SegmentRegion& region, const Interval& near,
                        EyeWork& work) const;

  const Scene& scene_;
  PhotonBeamSettings settings_;
  BeamRecorder recorder_;
  std::vector<Map> by_medium_;
};

}  // namespace vpm
