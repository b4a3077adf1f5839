// Gathering along the segments of a bundle of rays at once, in one homogeneous medium: the segments lie side by side, a
// lane for each.
#pragma once

#include <algorithm>

#include "vpm/estimate/extinction.h"
#include "vpm/estimate/segment_region.h"
#include "vpm/integrators/photon_map/estimator.h"
#include "vpm/photon/map/ray_bundle.h"
#include "vpm/photon/map/ray_lanes.h"

namespace vpm {

/// Segments of rays, a lane for each. Lanes that no segment is in find nothing.
class SegmentLanes {
 public:
  /// `region` is that of the segment, and `near` the part of its ray that perpendiculars of photons or beams may stand
  /// on, m from its origin.
  void set(size_t lane, const EyeSegment& segment, const SegmentRegion& region, const Interval& near, const Vec3& apex);

  /// -1 where a place, counted from the ray's origin, lies in the region; else 0.
  LaneMask hold(const Floats3& places) const {
    LaneMask held = -1;
    for (int k = 0; k < plane_count_; ++k) held &= dot(planes_[k].normal, places) >= planes_[k].offset;
    return held;
  }
  /// How far light of places, counted likewise, passes to the eye, m: from where SegmentRegion takes them to lie.
  [[gnu::always_inline]] Floats distances_to_eye(const Floats3& places) const {
    const Floats distances = dot(slope_, places) + plane_;
    const Floats past_start = max(distances, 2.0f * start_ - distances);  // Mirrored
    return max(start_, min(past_start, 2.0f * end_ - past_start)) - start_;
  }

  const RayLanes& rays() const { return rays_; }

 private:
  struct Plane {
    Floats3 normal;
    Floats offset = -kInfinity;
  };

  RayLanes rays_;
  Floats3 slope_;  // PlaneDistances
  Floats plane_{};
  Floats start_{}, end_{};  // Mirrored
  std::array<Plane, HalfSpaces::kMost> planes_;
  int plane_count_ = 0;
};

/// What lanes add up to.
struct LaneEstimates {
  std::array<Floats, 3> value{}, correction{};  // channel by channel
  LaneMask used{};
};

/// The sums of many LaneEstimates, in doubles.
class LaneTotals {
 public:
  /// Those times `factor`.
  void add(const LaneEstimates& some, double factor);
  KernelPair<Rgbd> total(size_t lane) const { return {value_[lane], correction_[lane]}; }
  uint64_t used() const { return used_; }

 private:
  std::array<Rgbd, kBlock> value_{}, correction_{};
  uint64_t used_ = 0;
};

/// Calls use(bundle of up to kBlock segments) for the segments of rays that lie side by side, kBlock after kBlock.
template <class Use>
void each_block(SegmentBundle bundle, Use&& use) {
  for (size_t first = 0; first < bundle.size(); first += kBlock)
    use(bundle.subspan(first, std::min<size_t>(kBlock, bundle.size() - first)));
}

/// Is a bundle so narrow that most of what one of its rays finds is found by the others, too? `bounds` of all that is
/// gathered, `most_radii`: how wide it may be, half way between the ends of what its segments reach, or where light
/// has come a free path.
bool is_narrow(const Vec3& apex, SegmentBundle bundle, const Box& bounds, float radius, float most_radii);

/// The rays of a bundle, as far as what is gathered within the radius of its bounds.
RayBundle rays_of(const Vec3& apex, SegmentBundle bundle, const Box& bounds, float radius);

/// Up to kBlock segments of a bundle in lanes, each with its region.
class GatherLanes {
 public:
  GatherLanes(const Vec3& apex, SegmentBundle bundle, const GatherSettings& settings, Spread spread, const Box& bounds);

  /// Does any segment come near what is gathered?
  bool any() const { return farthest_ > nearest_; }
  /// Do all places of their regions lie on the rays' side of the apex, so that rays() holds them?
  bool ahead() const { return nearest_ >= 0.0f; }
  const SegmentLanes& segments() const { return lanes_; }
  size_t size() const { return bundle_.size(); }
  /// How many segments come near it.
  size_t searching() const { return searching_; }
  RayBundle rays() const;
  /// Adds to the segments' light what was found, times `factor`, over the share of what there is to be found.
  void add(const LaneTotals& found, const Rgb& factor);

 private:
  Vec3 apex_;
  SegmentBundle bundle_;
  float radius_;                                 // m
  float nearest_ = kInfinity, farthest_ = 0.0f;  // of the segments' parts, m from the apex
  size_t searching_ = 0;
  SegmentLanes lanes_;
  std::array<std::optional<SegmentRegion>, kBlock> regions_;  // of those that come near
};

/// Adds a photon's or a beam's power, attenuated over distances to the eye, m, and times `weight` and a kernel.
[[gnu::always_inline]] inline void add_light(const Rgb& power, const Extinction& extinction, const Floats& distances,
                                             const Floats& weight, const KernelPair<Floats>& kernel,
                                             LaneEstimates& sums) {
  Floats value, correction;
  for (int c = 0; c < 3; ++c) {
    if (c == 0 || !extinction.repeats[c]) {
      const Floats passed = weight * exp_negative(-extinction.sigma_t[c] * distances);
      value = passed * kernel.value;
      correction = passed * kernel.correction;
    }
    sums.value[c] += power[c] * value;
    sums.correction[c] += power[c] * correction;
  }
}
/// The same where of the power only `left` comes so far, channel by channel.
inline void add_light(const Rgb& power, const FloatsRgb& left, const Extinction& extinction, const Floats& distances,
                      const Floats& weight, const KernelPair<Floats>& kernel, LaneEstimates& sums) {
  for (int c = 0; c < 3; ++c) {
    const Floats light = power[c] * left[c] * weight * exp_negative(-extinction.sigma_t[c] * distances);
    sums.value[c] += light * kernel.value;
    sums.correction[c] += light * kernel.correction;
  }
}

}  // namespace vpm
