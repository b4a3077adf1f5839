// Merges with beams: flights of light sub-paths that cross rays from the camera.
#pragma once

#include <array>
#include <span>

#include "vpm/estimate/combined/combined.h"

namespace vpm {

/// The techniques that have beams.
inline constexpr std::array kBeamTechniques{Technique::short_beams, Technique::long_beams};

/// What a technique finds along a segment, W/(m^2 sr): with its shares, and without.
struct Merged {
  KernelEstimate light;
  Rgb unweighted{0.0f};
};

/// Short or long beams. The scratch of `work` has the density integrals along the segment, unless the medium is
/// homogeneous.
Merged merge_beams(const CombinedContext& context, Technique technique, const RaySegment& segment, EyeWork& work);

/// The same for up to kEyeRays segments of rays from one point that lie side by side, in one homogeneous medium. What
/// each finds is put into `merged` at its place.
void merge_beams(const CombinedContext& context, Technique technique, const Vec3& apex,
                 std::span<const RaySegment> bundle, EyeWork& work, std::span<Merged> merged);

}  // namespace vpm
