// Photon beams met by eye rays [Jarosz2011]: all flights of photons that pass a segment of an eye ray closely. Each is
// spread over a kernel of one dimension, along the common perpendicular of the two lines. Beams that run nearly along
// the ray would be very bright; they are combined with the photons that collide beside it (BeamBalance).
#pragma once

#include "vpm/estimate/segment_region.h"
#include "vpm/integrators/photon_map/volume/beam_maps.h"
#include "vpm/integrators/photon_map/volume/beam_radiance.h"
#include "vpm/integrators/photon_map/volume/bundle_gather.h"
#include "vpm/integrators/photon_map/volume/pass_to_eye.h"

namespace vpm {

/// Gathers the beams of the medium that the segment is in. Beside planes, it gathers light whose last flight began at a
/// collision from beams alone.
class PhotonBeams final : public VolumeEstimator {
 public:
  PhotonBeams(const Scene& scene, const VolumeSettings& settings, const MediaPass& pass,
              std::optional<PlaneUse> planes = {});

  ScatteredLight finds() const override { return collisions_.finds(); }
  std::vector<MapInfo> maps() const override;
  Recorders recorders() override;
  void build(uint64_t emitted, RenderStatistics& statistics) override { build_beside(0.0f, emitted, statistics); }
  /// build() beside planes, one for this share of the flights; 0: there are none.
  void build_beside(float kept_planes, uint64_t emitted, RenderStatistics& statistics);
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;
  void along_bundle(const Vec3& apex, SegmentBundle bundle) const override;
  float kernel_variance(MediumId medium) const override { return variance_of(beams_[medium].settings, 1); }
  const BeamBalance& balance(MediumId medium) const { return beams_[medium].balance; }

 private:
  /// The collision that a beam's flight began at, if any.
  struct Begin {
    Vec3 from;      // the direction before, unit
    float sigma_s;  // 1/m, the mean of its channels; 0: none
  };
  struct Map {
    GatherSettings settings;  // of this pass
    BeamBalance balance;
    PhotonBeamMap beams;
    std::vector<Begin> begins;  // of the beams; empty if there are no planes

    size_t memory_bytes() const { return beams.memory_bytes() + begins.capacity() * sizeof(Begin); }
  };

  KernelEstimate beams_along(const EyeSegment& segment, const Map& map, EyeWork& work) const;
  KernelEstimate gather(const EyeSegment& segment, const SegmentRegion& region, const Interval& near, const Map& map,
                        EyeWork& work) const;
  /// What passes to the eye, times what is left of beams' powers where they cross; and the beams' shares over sines.
  size_t pass_beams(const EyeSegment& segment, const SegmentRegion& region, const Map& map, const PassToEye& pass,
                    const BeamCrossings& found, Passed& passed, float* share, WalkCounters& counters) const;
  void beams_along_bundle(const Vec3& apex, SegmentBundle bundle, const Map& map) const;
  LaneTotals sum_in_lanes(const Medium& medium, const Map& map, const PhotonBeamMap::Selection& near,
                          const GatherLanes& lanes, GatherCounters& counters) const;
  void share_with_planes(const Vec3& ray, const Map& map, const BeamCrossings& found, float* share) const;

  std::optional<PlaneUse> planes_;  // beside these
  BeamMaps<Map> beams_;
  VolumeMaps<BeamMap> collisions_;
};

}  // namespace vpm
