// Filling lanes, sums over them, and regions lane by lane, as a segment alone has them.
#include "vpm/integrators/photon_map/volume/bundle_gather.h"

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

namespace {

using Directions = std::array<Vec3, kEyeRays>;

std::span<const Vec3> directions_of(SegmentBundle bundle, Directions& directions) {
  for (size_t i = 0; i < bundle.size(); ++i) directions[i] = bundle[i].segment->ray.direction;
  return {directions.data(), bundle.size()};
}

/// How far, from the apex, rays are near the bounds, m; empty where none is.
Interval reach_of(const Vec3& apex, SegmentBundle bundle, const Box& bounds, float radius) {
  Interval reach{kInfinity, 0.0f};
  for (const BundledSegment& of : bundle) {
    const Ray& ray = of.segment->ray;
    // Past the ends there may be photons of the region, but not farther than the segment is long.
    const Interval near = clip(ray, {0.0f, 2.0f * of.segment->interval.t1}, bounds, radius);
    if (near.empty()) continue;
    const float before = glm::distance(apex, ray.origin);
    reach = {std::min(reach.t0, before + near.t0), std::max(reach.t1, before + near.t1)};
  }
  return reach;
}

}  // namespace

bool is_narrow(const Vec3& apex, SegmentBundle bundle, const Box& bounds, float radius, float most_radii) {
  Directions directions;
  const float free_path = 1.0f / mean_channel(bundle.front().segment->around()->sigma_t);
  return is_narrow(directions_of(bundle, directions), reach_of(apex, bundle, bounds, radius), free_path,
                   most_radii * radius);
}

RayBundle rays_of(const Vec3& apex, SegmentBundle bundle, const Box& bounds, float radius) {
  Directions directions;
  return {apex, directions_of(bundle, directions), reach_of(apex, bundle, bounds, radius).t1 + radius};
}

GatherLanes::GatherLanes(const Vec3& apex, SegmentBundle bundle, const GatherSettings& settings, Spread spread,
                         const Box& bounds)
    : apex_(apex), bundle_(bundle), radius_(settings.radius) {
  for (size_t i = 0; i < bundle.size(); ++i) {
    const EyeSegment& segment = *bundle[i].segment;
    const SegmentRegion& region = regions_[i].emplace(segment, settings, spread);
    const Interval near = clip(segment.ray, region.reach(), bounds, radius_);
    if (near.empty()) {
      regions_[i].reset();
      continue;
    }
    ++searching_;
    lanes_.set(i, segment, region, near, apex);
    const float from = glm::distance(apex, segment.ray.origin);
    nearest_ = std::min(nearest_, from + near.t0);
    farthest_ = std::max(farthest_, from + near.t1);
  }
}

RayBundle GatherLanes::rays() const {
  Directions directions;
  return {apex_, directions_of(bundle_, directions), farthest_ + radius_};
}

void GatherLanes::add(const LaneTotals& found, const Rgb& factor) {
  for (size_t i = 0; i < bundle_.size(); ++i) {
    if (!regions_[i]) continue;
    const EyeSegment& segment = *bundle_[i].segment;
    EyeWork& work = *bundle_[i].work;
    const KernelEstimate light{Rgb(found.total(i).value) * segment.throughput * factor,
                               Rgb(found.total(i).correction) * segment.throughput * factor};
    if (regions_[i]->whole() || is_black(light.value)) {
      bundle_[i].light += light;
      continue;
    }
    const SeenAlong seen(segment.around()->sigma_t, segment.interval, nullptr);
    bundle_[i].light += over_share(light, regions_[i]->share(radius_, seen, work.rng), work.counters.gather);
  }
}

}  // namespace vpm
