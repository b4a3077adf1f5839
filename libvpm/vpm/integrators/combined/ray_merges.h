// Merges along rays from the camera: with photons beside them, and with flights that cross them.
#pragma once

#include <array>
#include <span>

#include "vpm/integrators/combined/combined.h"

namespace vpm {

/// A part of a ray along which light sub-paths are merged, in a medium that scatters. The ray comes straight from the
/// camera, or over mirrors and glass alone; `throughput` is that at its last vertex.
struct MergeSegment : Segment {
  Rgb passed{1.0f};       // the transmittance from that vertex to the ray's origin
  float before = 0.0f;    // from the vertex to there, m
  double adjacent = 0.0;  // Departure::adjacent over Departure::forward of the vertex
  size_t number = 0;      // of the ray among those that are followed together
};

/// What a technique finds along a segment, W/(m^2 sr): with its shares, and without.
struct Merged {
  KernelEstimate light;
  Rgb unweighted{0.0f};
};

/// The techniques that merge whole rays.
inline constexpr std::array kRayTechniques{Technique::points_2d, Technique::short_beams};

/// One of these. The scratch of `work` has the density integrals along the segment, unless the medium is homogeneous.
Merged merge_along(const CombinedContext& context, Technique technique, const MergeSegment& segment, EyeWork& work);

/// The same for up to kEyeRays segments of rays from one point that lie side by side, in one homogeneous medium. What
/// each finds is put into `merged` at its place.
void merge_along(const CombinedContext& context, Technique technique, const Vec3& apex,
                 std::span<const MergeSegment> bundle, EyeWork& work, std::span<Merged> merged);

// By technique
Merged merge_points(const CombinedContext& context, const MergeSegment& segment, EyeWork& work);
void merge_points(const CombinedContext& context, const Vec3& apex, std::span<const MergeSegment> bundle, EyeWork& work,
                  std::span<Merged> merged);
Merged merge_beams(const CombinedContext& context, const MergeSegment& segment, EyeWork& work);
void merge_beams(const CombinedContext& context, const Vec3& apex, std::span<const MergeSegment> bundle, EyeWork& work,
                 std::span<Merged> merged);

}  // namespace vpm
