// The beam radiance estimate [Jarosz2008beam]: all photons near a segment of the eye ray, by one query of each map.
#pragma once

#include "vpm/estimate/beam_estimate.h"
#include "vpm/integrators/photon_map/volume/beam_balance.h"
#include "vpm/integrators/photon_map/volume/volume_maps.h"

namespace vpm {

/// For VolumeMaps::build().
BeamMap make_beam_map(std::vector<Photon>& photons, const GatherSettings& gather, float shrunk, uint64_t emitted,
                      const PassOfMaps& pass, RenderStatistics& statistics);

/// Gathers photons of the medium that the segment is in, over discs perpendicular to the ray. If they find the light
/// together with photon beams, `balance` says which share they have; null: all.
KernelEstimate photons_beside(const EyeSegment& segment, const BeamMap& map, VolumeForm form,
                              const BeamBalance* balance, EyeWork& work);

/// Adds the same to the light of a bundle's segments.
void photons_beside_bundle(const Vec3& apex, SegmentBundle bundle, const BeamMap& map, VolumeForm form,
                           const BeamBalance* balance);

class BeamRadiance final : public VolumeEstimator {
 public:
  BeamRadiance(const Scene& scene, const VolumeSettings& settings, const MediaPass& pass)
      : maps_(scene, settings, pass, 2) {}

  ScatteredLight finds() const override { return maps_.finds(); }
  std::vector<MapInfo> maps() const override { return maps_.maps(); }
  Recorders recorders() override { return maps_.recorders(); }
  void build(uint64_t emitted, RenderStatistics& statistics) override;
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;
  void along_bundle(const Vec3& apex, SegmentBundle bundle) const override;
  float kernel_variance(MediumId medium) const override { return variance_of(maps_[medium].settings, 2); }

 private:
  VolumeMaps<BeamMap> maps_;
};

}  // namespace vpm
