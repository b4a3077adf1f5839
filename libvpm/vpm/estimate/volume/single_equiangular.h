// Single scattering along a segment of an eye ray, found at a few distances. Each is drawn either equiangularly towards
// the light, or with the density of what scatters and reaches the eye. MIS weights combine the two.
#pragma once

#include "vpm/estimate/volume/estimator.h"
#include "vpm/estimate/volume/scattered_light.h"

namespace vpm {

/// Draws pairs of distances, each pair with a point of a light of its own. Where there is such a point, one distance of
/// the pair is equiangular [Kulla2012], and the MIS weights of both are those of the balance heuristic [Veach1997,
/// ch. 9].
class SingleEquiangular final : public VolumeEstimator {
 public:
  /// `pairs` >= 1, on each segment.
  SingleEquiangular(const Scene& scene, std::shared_ptr<const TransmittanceEstimator> transmittance, int pairs)
      : light_(scene, std::move(transmittance)), pairs_(pairs) {}

  ScatteredLight finds() const override { return {.once = true}; }
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;

 private:
  ScatteredOnce light_;
  int pairs_;
};

}  // namespace vpm
