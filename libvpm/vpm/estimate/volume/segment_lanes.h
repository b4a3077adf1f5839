// Segments of rays that lie side by side, a lane for each: whatever is gathered is taken to all of them at once.
#pragma once

#include "vpm/estimate/segment_region.h"
#include "vpm/photon/ray_lanes.h"

namespace vpm {

/// Lanes that no segment is in find nothing.
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
  Floats distances_to_eye(const Floats3& places) const {
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

}  // namespace vpm
