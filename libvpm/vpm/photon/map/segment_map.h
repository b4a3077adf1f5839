// The photon map that is searched along a segment of a ray: a hierarchy of boxes over leaves of up to 16 photons that
// lie close together.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "vpm/base/counters.h"
#include "vpm/base/vec.h"
#include "vpm/photon/map/box_tree.h"
#include "vpm/photon/map/leaf_order.h"
#include "vpm/photon/map/photon_batch.h"
#include "vpm/photon/map/ray_bundle.h"

namespace vpm {

/// Over which discs photons are spread.
struct BeamRadii {
  static constexpr float kLeastShare = 0.01f;

  float largest = 0.0f;  // m, > 0
  uint32_t count = 0;    // > 0: each photon has the radius of a ball of about so many photons, times `scale`, but at
                         // least kLeastShare of the largest (photons in a plane fill no ball); 0: the largest
  float scale = 1.0f;
};

/// How far along a ray photons count as lying: distances from a plane that the ray crosses, along the ray's direction.
struct PlaneDistances {
  Vec3 slope{0.0f};  // the distance is `slope` . offset from the ray's origin + `from`, m
  float from = 0.0f;

  float of(const Vec3& offset) const { return glm::dot(slope, offset) + from; }
};

/// Where photons count for a ray: their projections onto it lie in the interval, their offsets from its origin in the
/// half spaces.
struct BesideRay {
  BesideRay(const Ray& along, const Interval& projections)
      : ray(along), interval(projections), distances{along.direction} {}
  BesideRay(const Ray& along, const Interval& projections, const HalfSpaces& in, const PlaneDistances& by)
      : ray(along), interval(projections), within(in), distances(by) {}

  Ray ray;
  Interval interval;  // m
  HalfSpaces within;
  PlaneDistances distances;  // by default those of the projections
};

/// Photons whose perpendicular distance from a ray is less than their radius.
struct PhotonsNearRay {
  const PhotonBatch& batch;
  const float* distance;  // by BesideRay::distances, m
  const float* radius;    // m
};

/// Photons that rays of a bundle may pass more closely than their radii.
struct BundledPhotons {
  static constexpr size_t kMost = 128;

  size_t size = 0;
  float x[kMost], y[kMost], z[kMost];     // from the bundle's apex, m
  float dx[kMost], dy[kMost], dz[kMost];  // their directions of travel, unit
  float r[kMost], g[kMost], b[kMost];     // powers, W, over the photons emitted
};

class SegmentMap {
 public:
  SegmentMap() = default;
  /// Sorts the photons, with powers multiplied by `scale`: 1/emitted.
  SegmentMap(const std::vector<Photon>& photons, const BeamRadii& radii, float scale);

  /// Calls visit(const PhotonsNearRay&) for the photons there that are nearer to the ray than their radii, a batch at a
  /// time, in a fixed order. Returns how many photons it computed the distance of.
  template <class Visit>
  uint32_t visit_near_ray(const BesideRay& there, Visit&& visit) const;

  /// Calls visit(const BundledPhotons&) for those near the rays of a bundle, some at a time, in a fixed order. Returns
  /// how many photons it looked at.
  template <class Visit>
  uint32_t visit_near_bundle(const RayBundle& bundle, Visit&& visit) const;

  const PhotonTable& photons() const { return photons_; }
  float radius(size_t i) const;  // m, of photon `i` in the map's order

  size_t size() const { return photons_.size(); }
  const Box& bounds() const { return bounds_; }
  size_t memory_bytes() const;

 private:
  static constexpr size_t kLeaf = kBlock;  // photons of a leaf, at most
  /// Calls visit(const PhotonsNearRay&) for photons numbered by leaf and place in it.
  template <class Visit>
  void unpack(const BesideRay& there, const NearPhotons& near, Visit&& visit) const;

  /// Sets the photons' radii, and the boxes around their discs.
  void choose_radii(const BeamRadii& radii);
  Box box_of(size_t begin, size_t end) const;

  size_t leaves_ = 1;
  PhotonTable photons_;        // leaf by leaf
  std::vector<float> radius_;  // of the photons of a leaf, m
  BoxTree boxes_;              // around the photons' discs
  Box bounds_;
};

template <class Visit>
void SegmentMap::unpack(const BesideRay& there, const NearPhotons& near, Visit&& visit) const {
  const Vec3 origin = there.ray.origin;
  const auto [slope, from] = there.distances;
  uint32_t photons[NearPhotons::kMost];
  float radius[NearPhotons::kMost], distance[NearPhotons::kMost], kept2[NearPhotons::kMost];
  float x[NearPhotons::kMost], y[NearPhotons::kMost], z[NearPhotons::kMost];  // from the ray's origin, m
  size_t count = near.size();
  if (count == 0) return;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t leaf = near.photons()[i] / kBlock;
    photons[i] = static_cast<uint32_t>(leaf_begin(size(), leaves_, leaf)) + near.photons()[i] % kBlock;
    radius[i] = radius_[leaf];
    const Vec3 offset = photons_.position(photons[i]) - origin;
    x[i] = offset.x;
    y[i] = offset.y;
    z[i] = offset.z;
    distance[i] = glm::dot(slope, offset) + from;
  }
  const float* distance2 = near.distances2();
  if (!there.within.hold_all(x, y, z, count)) {
    size_t kept = 0;
    for (size_t i = 0; i < count; ++i) {
      photons[kept] = photons[i];
      radius[kept] = radius[i];
      distance[kept] = distance[i];
      kept2[kept] = distance2[i];
      kept += there.within.hold({x[i], y[i], z[i]}) ? 1 : 0;
    }
    count = kept;
    distance2 = kept2;
  }
  if (count == 0) return;
  const PhotonBatch batch(photons_, photons, distance2, count);
  std::fill(radius + count, radius + batch.size(), radius[0]);
  std::fill(distance + count, distance + batch.size(), distance[0]);
  visit(PhotonsNearRay{batch, distance, radius});
}

template <class Visit>
uint32_t SegmentMap::visit_near_bundle(const RayBundle& bundle, Visit&& visit) const {
  if (size() == 0) return 0;
  const Vec3 apex = bundle.apex();
  uint32_t near[BundledPhotons::kMost + kBlock], visited = 0;
  float unused[kBlock];
  size_t found = 0;
  BundledPhotons photons;
  const auto use = [&] {
    for (size_t i = 0; i < found; ++i) {
      const Vec3 offset = photons_.position(near[i]) - apex;
      const PhotonTable::Payload& payload = photons_.payload(near[i]);
      const Vec3 travel = payload.travel.unpack();
      const Rgb power = payload.power.unpack();
      photons.x[i] = offset.x;
      photons.y[i] = offset.y;
      photons.z[i] = offset.z;
      photons.dx[i] = travel.x;
      photons.dy[i] = travel.y;
      photons.dz[i] = travel.z;
      photons.r[i] = power.r;
      photons.g[i] = power.g;
      photons.b[i] = power.b;
    }
    photons.size = found;
    if (found > 0) visit(std::as_const(photons));
    found = 0;
  };
  boxes_.visit_leaves(bundle, [&](uint32_t leaf) {
    const size_t begin = leaf_begin(size(), leaves_, leaf), end = leaf_begin(size(), leaves_, leaf + 1);
    const float reach = 1.0001f * radius_[leaf];
    photons_.for_each_block(begin, end, apex, bundle.region(),
                            [&](const float* outside, uint32_t number, uint32_t first) {
                              found += append_below(outside, number, reach, first, unused, near + found);
                              if (found > BundledPhotons::kMost - kBlock) use();
                            });
    count(visited, end - begin);
  });
  use();
  return visited;
}

template <class Visit>
uint32_t SegmentMap::visit_near_ray(const BesideRay& there, Visit&& visit) const {
  if (size() == 0) return 0;
  NearPhotons found;  // numbered by leaf and place in it
  const auto use = [&](const NearPhotons& near) { unpack(there, near, visit); };
  uint32_t visited = 0;
  boxes_.visit_leaves(there.ray, there.interval, [&](uint32_t leaf) {
    const size_t begin = leaf_begin(size(), leaves_, leaf), end = leaf_begin(size(), leaves_, leaf + 1);
    const float limit2 = radius_[leaf] * radius_[leaf];
    photons_.for_each_block(begin, end, there.ray, there.interval,
                            [&](const float* distances2, uint32_t number, uint32_t) {
                              found.add(distances2, number, leaf * kBlock, limit2, use);
                            });
    count(visited, end - begin);
  });
  found.take(use);
  return visited;
}

}  // namespace vpm
