// Filling lanes, and sums over them.
#include "vpm/estimate/volume/segment_lanes.h"

#include <algorithm>

namespace vpm {

void SegmentLanes::set(size_t lane, const EyeSegment& segment, const SegmentRegion& region, const Interval& near,
                       const Vec3& apex) {
  rays_.set(lane, segment.ray, near, apex);
  const PlaneDistances distances = region.distances();
  slope_.set(lane, distances.slope);
  plane_.set(lane, distances.from);
  start_.set(lane, region.mirrored().t0);
  end_.set(lane, region.mirrored().t1);
  const HalfSpaces& within = region.within();
  plane_count_ = std::max(plane_count_, within.count());
  for (int k = 0; k < within.count(); ++k) {
    planes_[k].normal.set(lane, within.normal(k));
    planes_[k].offset.set(lane, within.offset(k));
  }
}

void LaneTotals::add(const LaneEstimates& some, double factor) {
  for (size_t i = 0; i < kBlock; ++i) {
    value_[i] += factor * Rgbd(some.value[0][i], some.value[1][i], some.value[2][i]);
    correction_[i] += factor * Rgbd(some.correction[0][i], some.correction[1][i], some.correction[2][i]);
    used_ += static_cast<uint64_t>(some.used[i]);
  }
}

}  // namespace vpm
