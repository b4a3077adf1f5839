// Rays in lanes along which light sub-paths are merged, and what merges add up to.
#pragma once

#include <algorithm>
#include <span>
#include <type_traits>

#include "vpm/estimate/extinction.h"
#include "vpm/estimate/eye_segment.h"
#include "vpm/estimate/volume_estimate.h"
#include "vpm/integrators/combined/ray_merges.h"
#include "vpm/photon/map/ray_bundle.h"
#include "vpm/photon/map/ray_lanes.h"
#include "vpm/photon/stored_power.h"

namespace vpm {

/// What merges need of rays, one ray a lane.
struct MergingRays {
  FloatsRgb passed{};  // MergeSegment::passed
  Floats before{};     // MergeSegment::before
  Floats splats{};     // MergeSegment::adjacent over the `unit` of set(), as techniques take densities relative to it
  Floats3 along;       // directions, unit

  void set(size_t lane, const MergeSegment& segment, double unit) {
    for (int c = 0; c < 3; ++c) passed[c].set(lane, segment.passed[c]);
    before.set(lane, segment.before);
    splats.set(lane, static_cast<float>(std::min(segment.adjacent / unit, 1e30)));
    along.set(lane, segment.ray.direction);
  }
};
/// The same ray in all lanes.
inline MergingRays rays_of(const MergeSegment& segment, double unit) {
  MergingRays rays;
  for (size_t lane = 0; lane < kBlock; ++lane) rays.set(lane, segment, unit);
  return rays;
}

/// The medium along rays, as far as merges need it.
class MergingMedium {
 public:
  MergingMedium(const CombinedContext& context, const Medium& medium)
      : extinction_(medium.sigma_t),
        floor_(medium.grid ? floor_in(medium, context.counts.density_floor) : 0.0f),
        per_largest_(relative_density(medium, 1.0f)) {}

  const Extinction& extinction() const { return extinction_; }
  const Rgb& sigma_t() const { return extinction_.sigma_t; }  // at density 1, 1/m
  /// Densities over the largest one.
  Floats relative(const Floats& density) const { return density * per_largest_; }
  /// Junction::kept.
  Floats kept(const Floats& relative_density) const { return max(1.0f, floor_ / relative_density); }

 private:
  Extinction extinction_;
  float floor_;  // of relative densities, below which photons are kept along flights
  float per_largest_;
};

/// Calls use(phase function of the medium, profile of the kernel, whether the heuristic weighs by squares), each of a
/// type that loops can inline.
template <int Dimension, class Use>
auto with_types_of_merge(const CombinedContext& context, const Medium& medium, Use&& use) {
  const auto with = [&](const auto& phase, auto profile) {
    if (context.counts.heuristic == Heuristic::power) return use(phase, profile, std::true_type());
    return use(phase, profile, std::false_type());
  };
  return with_phase_and_kernel<Dimension>(medium.phase, context.kernels.volume_kernel, with);
}

/// What merges add up to, without the kernel's norm: with shares, and without.
struct LaneMerges {
  FloatsRgb value{}, correction{}, unweighted{};

  template <class Profile>
  void add(const FloatsRgb& light, const Floats& share, const Floats& q, const Profile& profile) {
    const KernelPair<Floats> kernel = profile(q);
    for (int c = 0; c < 3; ++c) {
      unweighted[c] += light[c] * kernel.value;
      value[c] += light[c] * kernel.value * share;
      correction[c] += light[c] * kernel.correction * share;
    }
  }
};

/// The sums of many LaneMerges, in doubles.
struct MergedSum {
  Rgbd value{0.0}, correction{0.0}, unweighted{0.0};

  void add(const LaneMerges& sums, size_t lane) {
    for (int c = 0; c < 3; ++c) {
      value[c] += sums.value[c][lane];
      correction[c] += sums.correction[c][lane];
      unweighted[c] += sums.unweighted[c][lane];
    }
  }
  MergedSum& operator+=(const MergedSum& other) {
    value += other.value;
    correction += other.correction;
    unweighted += other.unweighted;
    return *this;
  }
  Merged times(const Rgb& factor) const {
    return {{Rgb(value) * factor, Rgb(correction) * factor}, Rgb(unweighted) * factor};
  }
};

/// The sums of what many photons or beams bring to rays in lanes: in floats as long as these are few.
class MergedTotals {
 public:
  /// Where the next one is to be added.
  LaneMerges& next() {
    if (in_floats_ == kMostInFloats) flush();
    ++in_floats_;
    return floats_;
  }
  /// All that has been added, lane by lane.
  const std::array<MergedSum, kBlock>& of_lanes() {
    flush();
    return sums_;
  }
  /// All that has been added.
  MergedSum of_all() {
    MergedSum all;
    for (const MergedSum& sum : of_lanes()) all += sum;
    return all;
  }

 private:
  static constexpr uint32_t kMostInFloats = 128;

  void flush() {
    for (size_t lane = 0; lane < kBlock; ++lane) sums_[lane].add(floats_, lane);
    floats_ = {};
    in_floats_ = 0;
  }

  LaneMerges floats_;
  uint32_t in_floats_ = 0;
  std::array<MergedSum, kBlock> sums_;
};

// --- Many rays

using Directions = std::array<Vec3, kEyeRays>;
inline std::span<const Vec3> directions_of(std::span<const MergeSegment> bundle, Directions& directions) {
  for (size_t i = 0; i < bundle.size(); ++i) directions[i] = bundle[i].ray.direction;
  return {directions.data(), bundle.size()};
}

/// The part of the segments that lies within the radius of the bounds, m from the apex; empty where there is none.
inline Interval reach_of(std::span<const MergeSegment> bundle, const Vec3& apex, const Box& bounds, float radius) {
  Interval reach{kInfinity, 0.0f};
  for (const MergeSegment& segment : bundle) {
    const Interval near = clip(segment.ray, segment.interval, bounds, radius);
    if (near.empty()) continue;
    const float before = glm::distance(apex, segment.ray.origin);
    reach = {std::min(reach.t0, before + near.t0), std::max(reach.t1, before + near.t1)};
  }
  return reach;
}

/// Up to kBlock rays of a bundle, as far as they lie within the radius of the bounds.
struct RayBlock {
  std::span<const MergeSegment> segments;
  RayLanes lanes;
  MergingRays rays;
  Vec3 apex{0.0f};
  float radius = 0.0f;  // m
  Interval reach;       // m from the apex

  RayBlock(std::span<const MergeSegment> block, const Vec3& from, const Box& bounds, float within, double unit)
      : segments(block), apex(from), radius(within), reach(reach_of(block, from, bounds, within)) {
    for (size_t i = 0; i < block.size(); ++i) {
      lanes.set(i, block[i].ray, clip(block[i].ray, block[i].interval, bounds, within), from);
      rays.set(i, block[i], unit);
    }
  }
  RayBundle bundle() const {
    Directions directions;
    return {apex, directions_of(segments, directions), reach.t1 + radius};
  }
};

/// What light sub-paths are merged by that lie in these bounds.
struct SearchedMap {
  Box bounds;
  float radius;      // of the kernel, m
  float most_radii;  // wider bundles look at much that few of their rays come near
  double unit;       // see MergingRays
};

/// Searches a map for a whole bundle, select(RayBundle), and merges block by block what was found, each(RayBlock, what
/// its segments find). Returns false, and does nothing, where the bundle is too wide for that.
template <class Select, class Each>
bool merge_together(const SearchedMap& map, float free_path, const Vec3& apex, std::span<const MergeSegment> bundle,
                    std::span<Merged> merged, Select&& select, Each&& each) {
  const auto& [bounds, radius, most_radii, unit] = map;
  const Interval reach = reach_of(bundle, apex, bounds, radius);
  if (reach.empty()) return true;
  Directions directions;
  const std::span<const Vec3> all = directions_of(bundle, directions);
  if (!is_narrow(all, reach, free_path, most_radii * radius)) return false;
  select(RayBundle(apex, all, reach.t1 + radius));
  for (size_t first = 0; first < bundle.size(); first += kBlock) {
    const size_t size = std::min<size_t>(kBlock, bundle.size() - first);
    const RayBlock block(bundle.subspan(first, size), apex, bounds, radius, unit);
    if (!block.reach.empty()) each(block, merged.subspan(first, size));
  }
  return true;
}

}  // namespace vpm
