// The photon map for the photons beside a stretch of a ray: a hierarchy of boxes over leaves of up to 32 photons that
// lie side by side. Eight boxes are met at once: those three levels below a box lie side by side, too.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "base/count.h"
#include "base/vec.h"
#include "photon/leaf_order.h"
#include "photon/photon_table.h"

namespace vpm {

class SegmentMap {
 public:
  using Payload = PhotonTable::Payload;

  SegmentMap() = default;
  /// Sorts the photons, with powers multiplied by `scale`: 1/emitted.
  SegmentMap(const std::vector<Photon>& photons, float scale);

  /// Calls visit(const Payload&, distance along the ray, m, squared distance from it) for the photons nearer to the ray
  /// than `radius`, m, whose foot on it lies in the interval, in a fixed order. Returns how many photons it computed
  /// the distance of.
  template <class Visit>
  uint32_t for_each_beside(const Ray& ray, const Interval& interval, float radius, Visit&& visit) const;

  size_t size() const { return photons_.size(); }
  const Box& bounds() const { return bounds_; }
  size_t memory_bytes() const;

 private:
  static constexpr size_t kLeaf = 32;  // photons of a leaf, at most
  static constexpr int kWide = 8;      // boxes met at once
  static constexpr int kLevels = 3;    // of the tree between them

  /// A ray as boxes are met.
  struct Beam {
    Vec3 origin, inverse;
    Interval interval;
    float radius;
  };
  /// Which of the `kWide` boxes from node `first` on the beam meets: a bit for each.
  uint32_t meet(const Beam& beam, size_t first) const;

  size_t leaves_ = 1;                          // nodes are numbered as LeafOrder says
  std::array<std::vector<float>, 3> lo_, hi_;  // of the nodes' boxes, m
  PhotonTable photons_;                        // leaf by leaf
  Box bounds_;
};

inline uint32_t SegmentMap::meet(const Beam& beam, size_t first) const {
  float enter[kWide], leave[kWide];
  for (int i = 0; i < kWide; ++i) {
    enter[i] = beam.interval.t0;
    leave[i] = beam.interval.t1;
  }
  for (int a = 0; a < 3; ++a) {
    const float *lo = &lo_[a][first], *hi = &hi_[a][first];
    for (int i = 0; i < kWide; ++i) {
      const float at_lo = (lo[i] - beam.radius - beam.origin[a]) * beam.inverse[a];
      const float at_hi = (hi[i] + beam.radius - beam.origin[a]) * beam.inverse[a];
      const float near = at_lo < at_hi ? at_lo : at_hi, far = at_lo < at_hi ? at_hi : at_lo;
      enter[i] = near > enter[i] ? near : enter[i];
      leave[i] = far < leave[i] ? far : leave[i];
    }
  }
  uint32_t met = 0;
  for (int i = 0; i < kWide; ++i) met |= (enter[i] <= leave[i] ? 1u : 0u) << i;
  return met;
}

template <class Visit>
uint32_t SegmentMap::for_each_beside(const Ray& ray, const Interval& interval, float radius, Visit&& visit) const {
  if (size() == 0) return 0;
  // Boxes grow by a hair more than the radius, so that rounding loses no photon that the last test would take; and no
  // component of the direction is so small that 0 times its inverse has no value.
  const Vec3 reach = glm::max(glm::max(glm::abs(bounds_.lo), glm::abs(bounds_.hi)), glm::abs(ray.origin));
  Beam beam{ray.origin, Vec3(0.0f), interval, 1.0001f * radius + 1e-6f * max_channel(reach)};
  for (int a = 0; a < 3; ++a) {
    const float d = ray.direction[a];
    beam.inverse[a] = 1.0f / (std::abs(d) < 1e-12f ? std::copysign(1e-12f, d) : d);
  }
  NearPhotons found(radius * radius);
  const auto use = [&](uint32_t i, float distance2) {
    const float t = glm::dot(photons_.position(i) - ray.origin, ray.direction);
    visit(photons_.payload(i), std::clamp(t, interval.t0, interval.t1), distance2);
  };
  const auto add = [&](const float* distances2, uint32_t number, uint32_t first) {
    found.add(distances2, number, first, use);
  };
  uint32_t visited = 0;
  size_t stack[12 * kWide];
  int top = 0;
  stack[top++] = 1;
  while (top > 0) {
    const size_t node = stack[--top];
    if (node >= leaves_) {
      const size_t leaf = node - leaves_;
      const size_t begin = leaf_begin(size(), leaves_, leaf), end = leaf_begin(size(), leaves_, leaf + 1);
      photons_.for_each_block(begin, end, ray, interval, add);
      count(visited, end - begin);
      continue;
    }
    const int below = std::bit_width(leaves_) - std::bit_width(node);  // levels from here to the leaves
    const int levels = below < kLevels ? below : kLevels;
    const size_t first = node << levels;
    uint32_t met = meet(beam, first) & ((1u << (1 << levels)) - 1);
    for (; met != 0; met &= met - 1) stack[top++] = first + static_cast<size_t>(std::countr_zero(met));
  }
  found.take(use);
  return visited;
}

}  // namespace vpm
