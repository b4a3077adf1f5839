// What one ray from the camera gathers for its neighbours.
//
// Rays that are a pixel apart sum nearly the same photons; where the kernels are wide beside pixels, that is most of
// the time of a pass. So the pixels of a picture make squares, in which one ray gathers, and the others take what it
// found where they see the same: the same medium, up to the same face. The lattice of squares and the place in them of
// the ray that gathers are drawn anew in each pass. In the mean over passes this blurs the light of photons a little
// more than their kernels do (papers/shared-gathers.md). Nothing is shared where it is not a small part of what they
// do.
#pragma once

#include <array>
#include <optional>

#include "vpm/base/vec.h"
#include "vpm/medium/phase/phase.h"
#include "vpm/photon/kernel.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// The variance along each axis, pixels^2, of the way from a pixel of a square to the one whose ray gathers.
constexpr float variance_in_square(int edge) { return static_cast<float>(edge * edge - 1) / 6.0f; }

/// The share in the variance of kernels that the blur may have.
inline constexpr float kMostBlur = 0.25f;

/// Does a phase function change little over directions that have such a variance (rad^2, along each axis)? The standard
/// deviation is at most a twentieth of the width of its peak, from the solid angle that a peak of that height has at
/// the most. Tables, which may have a peak anywhere, do not count as smooth.
bool is_smooth_over(const Phase& phase, float variance);

/// What a ray sees of a straight segment.
struct SeenSegment {
  MediumId medium = kVacuum;
  int shape = -1;    // that ends it; -1: none does
  Vec3 end{0.0f};    // the normal there, on the side of the segment; 0: none
  float length = 0;  // m
};
/// Do two rays see the same, so that light gathered by one stands for that of the other?
bool is_alike(const SeenSegment& a, const SeenSegment& b);

class SharedGather {
 public:
  static constexpr size_t kMostEstimators = 2;  // of media
  static constexpr size_t kMostSegments = 4;    // of a ray, straight from the camera

  /// The light of photons that a surface sends on.
  struct AtSurface {
    Vec3 shading_normal{0.0f};
    Rgb reflectance{0.0f};
    KernelEstimate light;  // W/(m^2 sr), of that reflectance
  };
  struct OfSegment {
    SeenSegment seen;
    Rgb throughput{1.0f};  // of the ray at the start of the segment, which light is times
    std::array<std::optional<KernelEstimate>, kMostEstimators> light;  // by estimator, W/(m^2 sr) at the camera
    std::optional<AtSurface> surface;                                  // at the end
  };

  SharedGather() = default;
  /// `variance` is that of the angle between rays of a square, along each axis, rad^2.
  explicit SharedGather(float variance) : variance_(variance) {}
  float variance() const { return variance_; }

  /// Begins the next segment of the ray that gathers; null where there is no room for it.
  OfSegment* begin(const SeenSegment& seen, const Rgb& throughput) {
    if (count_ == kMostSegments) return nullptr;
    OfSegment& segment = segments_[count_++] = {};
    segment.seen = seen;
    segment.throughput = throughput;
    return &segment;
  }
  /// Segment number `number` of the ray that gathers; null where another ray sees something else there.
  const OfSegment* find(size_t number, const SeenSegment& seen) const {
    return number < count_ && is_alike(segments_[number].seen, seen) ? &segments_[number] : nullptr;
  }
  /// The variance of the blur at a distance (m) from the camera, over that of kernels (m^2, along each axis). Nothing
  /// where it is too much to share, or where kernels have no one variance, which is 0 then.
  std::optional<float> blur(float distance, float of_kernels) const {
    const float ratio = variance_ * distance * distance / of_kernels;
    return of_kernels > 0.0f && ratio <= kMostBlur ? std::optional(ratio) : std::nullopt;
  }

 private:
  float variance_ = 0.0f;
  size_t count_ = 0;
  std::array<OfSegment, kMostSegments> segments_;
};

/// What photons find, blurred besides: the bias of kernels and of the blur go with their variances alike.
inline KernelEstimate blurred(const KernelEstimate& light, float blur) {
  return {light.value, light.correction * (1.0f + blur)};
}

}  // namespace vpm
