// Marching: sums light at points along the eye ray. Each point is drawn in proportion to the density that the eye sees
// there [Jarosz2008, eq. 7.9, corrected].
#pragma once

#include <optional>

#include "vpm/integrators/photon_map/estimator.h"
#include "vpm/integrators/photon_map/volume/points_of_segment.h"
#include "vpm/integrators/photon_map/volume/single_scattering.h"

namespace vpm {

/// The light of photons around the points, with the density at the query [Jarosz2008, eq. 7.10, corrected]; and that of
/// lights, by one shadow ray from each point.
class MarchedLight final : public VolumeEstimator {
 public:
  /// At least one of the two. `max_optical_step` is the largest optical thickness of a step, > 0.
  MarchedLight(std::optional<VolumeMaps<PhotonMap>> photons, std::optional<ScatteredOnce> lights,
               float max_optical_step);

  ScatteredLight finds() const override;
  std::vector<MapInfo> maps() const override;
  Recorders recorders() override;
  void build(uint64_t emitted, RenderStatistics& statistics) override;
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;
  /// Of photons alone: rays towards lights are shared by nobody.
  float kernel_variance(MediumId medium) const override {
    return photons_ && !lights_ ? variance_of((*photons_)[medium].settings, 3) : 0.0f;
  }

 private:
  class March;

  std::optional<VolumeMaps<PhotonMap>> photons_;
  std::optional<ScatteredOnce> lights_;
  float max_optical_step_;
};

}  // namespace vpm
