// Photon planes crossed by eye rays [Bitterli2017]: light that media scatter at least twice, the last two times one
// after the other. A plane has all places where the first of these two might have been on a photon's flight. So there
// is no kernel, and no bias.
//
// A plane that the ray nearly lies in is bright without bound, and so is the variance. Therefore planes are combined
// with photon beams; these also find all light whose last flight before the eye ray began at a light or at a surface.
#pragma once

#include <memory>

#include "vpm/integrators/photon_map/volume/photon_beams.h"
#include "vpm/medium/transmittance/estimator.h"
#include "vpm/photon/photon_plane.h"

namespace vpm {

/// That planes find all light that they can find (PlaneUse::alone) is for study: their variance is then infinite.
class PhotonPlanes final : public VolumeEstimator {
 public:
  PhotonPlanes(const Scene& scene, std::shared_ptr<const TransmittanceEstimator> transmittance,
               const VolumeSettings& settings, const MediaPass& pass);

  ScatteredLight finds() const override { return beams_.finds(); }
  std::vector<MapInfo> maps() const override { return beams_.maps(); }
  Recorders recorders() override;
  void build(uint64_t emitted, RenderStatistics& statistics) override;
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;
  void along_bundle(const Vec3& apex, SegmentBundle bundle) const override;

 private:
  Rgb planes_along(const EyeSegment& segment, EyeWork& work) const;
  /// Light of a plane that the segment crosses, without what follows the crossing: phase function, scattering and
  /// transmittance to the eye. W/m^2.
  Rgb arriving(const PlaneCrossing& crossing, const EyeSegment& segment, EyeWork& work) const;

  const Scene& scene_;
  std::shared_ptr<const TransmittanceEstimator> transmittance_;
  VolumeSettings settings_;
  MediaPass pass_;
  PhotonBeams beams_;
  BeamRecorder flights_;
  PhotonPlaneList planes_;
};

}  // namespace vpm
