// How far light of places beside a ray passes to the eye.
#pragma once

#include <span>

#include "vpm/estimate/beam_estimate.h"
#include "vpm/estimate/segment_region.h"

namespace vpm {

/// beam_transmittance() from places on a ray to the start of its segment; `distances` are those of SegmentRegion, m.
/// `integrals` are the density integrals along the ray, null in a homogeneous medium. For the density at the query, the
/// transmittances are multiplied by the relative density there.
void pass_to_eye(const Medium& medium, const DensityIntegralsAlong* integrals, VolumeForm form,
                 const Mirrored& mirrored, std::span<const float> distances, Passed& passed);

}  // namespace vpm
