// How far light of places beside a ray passes to the eye.
#pragma once

#include <span>

#include "vpm/estimate/beam_estimate.h"
#include "vpm/estimate/segment_region.h"

namespace vpm {

/// beam_transmittance() from places on a ray to the start of its segment. For the density at the query, transmittances
/// are multiplied by the relative density there.
class PassToEye {
 public:
  /// `integrals` are the density integrals along the ray, null in a homogeneous medium; they outlive this.
  PassToEye(const Medium& medium, const DensityIntegralsAlong* integrals, VolumeForm form, const Mirrored& mirrored)
      : medium_(medium), integrals_(integrals), form_(form), mirrored_(mirrored) {}

  /// `distances` are those of SegmentRegion, m, no more than a Passed has room for. `sigma_t`, unless null, becomes the
  /// extinction coefficient at the places, 1/m, the mean of its channels.
  void operator()(std::span<const float> distances, Passed& passed, float* sigma_t = nullptr) const;
  const DensityIntegralsAlong* integrals() const { return integrals_; }

 private:
  void pass_homogeneous(std::span<const float> distances, Passed& passed) const;
  void pass_grid(std::span<const float> distances, Passed& passed, float* sigma_t) const;

  const Medium& medium_;
  const DensityIntegralsAlong* integrals_;
  VolumeForm form_;
  Mirrored mirrored_;
};

}  // namespace vpm
