// The photon map that is searched along a segment of a ray: a hierarchy of boxes over leaves of up to 16 photons that
// lie close together. The sixteen boxes below a box are met at once: four levels of the tree that leaves are sorted by.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "vpm/base/count.h"
#include "vpm/base/vec.h"
#include "vpm/photon/half_spaces.h"
#include "vpm/photon/leaf_order.h"
#include "vpm/photon/photon_batch.h"

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

class SegmentMap {
 public:
  SegmentMap() = default;
  /// Sorts the photons, with powers multiplied by `scale`: 1/emitted.
  SegmentMap(const std::vector<Photon>& photons, const BeamRadii& radii, float scale);

  /// Calls visit(const PhotonsNearRay&) for the photons there that are nearer to the ray than their radii, a batch at a
  /// time, in a fixed order. Returns how many photons it computed the distance of.
  template <class Visit>
  uint32_t visit_near_ray(const BesideRay& there, Visit&& visit) const;

  const PhotonTable& photons() const { return photons_; }
  float radius(size_t i) const;  // m, of photon `i` in the map's order

  size_t size() const { return photons_.size(); }
  const Box& bounds() const { return bounds_; }
  size_t memory_bytes() const;

 private:
  static constexpr size_t kLeaf = kBlock;  // photons of a leaf, at most
  static constexpr int kLevels = 4;        // of LeafOrder's tree between a box and those below it
  static constexpr int kMostDepth = 8;     // of boxes: 2^32 leaves

  /// A ray as boxes are met. Along each axis it enters a box at the near plane times `inverse` plus `enter`, m, and
  /// leaves it at the far plane times `inverse` plus `leave`.
  struct Beam {
    Interval interval;
    Vec3 inverse, enter, leave;
    std::array<const float*, 3> near, far;  // of all boxes: their lower sides or their upper ones
  };
  Beam make_beam(const Ray& ray, const Interval& interval) const;
  /// The first of the boxes below a box, numbered among those of their depth, and how many there are.
  std::pair<uint32_t, uint32_t> children(int depth, uint32_t box) const {
    const uint32_t most = 1u << kLevels;
    return {box * most, static_cast<uint32_t>(std::min<size_t>(most, begin_[depth + 2] - begin_[depth + 1]))};
  }
  /// Appends to `met` which of the `count` boxes from that place on the beam meets, numbered from `first` on. Returns
  /// how many it does.
  uint32_t meet(const Beam& beam, size_t place, uint32_t count, uint32_t first, uint32_t* met) const;

  /// Calls visit(const PhotonsNearRay&) for photons numbered by leaf and place in it.
  template <class Visit>
  void unpack(const BesideRay& there, const NearPhotons& near, Visit&& visit) const;

  /// The photons' radii, leaf by leaf, and the boxes around their discs.
  void choose_radii(const BeamRadii& radii);
  void make_boxes();
  /// Makes the box at that place reach around those corners.
  void include(size_t place, const Vec3& lo, const Vec3& hi);
  Box box_of(size_t begin, size_t end) const;

  size_t leaves_ = 1;
  int depth_ = 0;                               // of the leaves' boxes; the root's is 0
  std::array<size_t, kMostDepth + 2> begin_{};  // of the boxes of each depth, and one past the last
  std::array<std::vector<float>, 3> lo_, hi_;   // m
  PhotonTable photons_;                         // leaf by leaf
  std::vector<float> radius_;                   // of the photons of a leaf, m
  Box bounds_;
};

inline uint32_t SegmentMap::meet(const Beam& beam, size_t place, uint32_t count, uint32_t first, uint32_t* met) const {
  const float *near_x = beam.near[0] + place, *near_y = beam.near[1] + place, *near_z = beam.near[2] + place;
  const float *far_x = beam.far[0] + place, *far_y = beam.far[1] + place, *far_z = beam.far[2] + place;
  const auto [t0, t1] = beam.interval;
  const Vec3 inverse = beam.inverse, at_enter = beam.enter, at_leave = beam.leave;
  float missed[kBlock], unused[kBlock];
  for (uint32_t i = 0; i < kBlock; ++i) {
    float enter = t0, leave = t1;
    enter = std::max(enter, near_x[i] * inverse.x + at_enter.x);
    enter = std::max(enter, near_y[i] * inverse.y + at_enter.y);
    enter = std::max(enter, near_z[i] * inverse.z + at_enter.z);
    leave = std::min(leave, far_x[i] * inverse.x + at_leave.x);
    leave = std::min(leave, far_y[i] * inverse.y + at_leave.y);
    leave = std::min(leave, far_z[i] * inverse.z + at_leave.z);
    missed[i] = enter <= leave ? 0.0f : 1.0f;
  }
  return append_below(missed, count, 0.5f, first, unused, met);
}

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
uint32_t SegmentMap::visit_near_ray(const BesideRay& there, Visit&& visit) const {
  if (size() == 0) return 0;
  const Ray& ray = there.ray;
  const Interval& interval = there.interval;
  const Beam beam = make_beam(ray, interval);
  NearPhotons found;  // numbered by leaf and place in it
  const auto use = [&](const NearPhotons& near) { unpack(there, near, visit); };
  struct Group {
    uint32_t begin, end;  // of `met`
  };
  // Boxes met and not looked into yet, depth by depth.
  uint32_t visited = 0, met[(kMostDepth + 1) * kBlock] = {0};
  Group waiting[kMostDepth + 1];
  waiting[0] = {0, 1};
  for (int depth = 0; depth >= 0;) {
    Group& group = waiting[depth];
    if (group.begin == group.end) {
      --depth;
      continue;
    }
    const uint32_t box = met[group.begin++];
    if (depth == depth_) {
      const size_t begin = leaf_begin(size(), leaves_, box), end = leaf_begin(size(), leaves_, box + 1);
      const float limit2 = radius_[box] * radius_[box];
      photons_.for_each_block(begin, end, ray, interval, [&](const float* distances2, uint32_t number, uint32_t) {
        found.add(distances2, number, box * kBlock, limit2, use);
      });
      count(visited, end - begin);
      continue;
    }
    const auto [first, below] = children(depth, box);
    const uint32_t begin = group.end, hits = meet(beam, begin_[depth + 1] + first, below, first, met + begin);
    waiting[++depth] = {begin, begin + hits};
  }
  found.take(use);
  return visited;
}

}  // namespace vpm
