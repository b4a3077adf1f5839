// Photons for merges, found around points and beside rays.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/base/below.h"
#include "vpm/base/counters.h"
#include "vpm/integrators/combined/merge_photons.h"
#include "vpm/photon/map/box_tree.h"

namespace vpm {

/// Finds photons within a radius: a hierarchy of boxes over leaves.
class MergeMap {
 public:
  MergeMap() = default;
  /// Of these photons, for radii of up to `reach`, m, > 0.
  MergeMap(const std::vector<MergePhoton>& photons, float reach);

  /// Calls visit(photon, squared distance) for the photons nearer to the point than the radius, in a fixed order.
  /// Returns how many it computed the distance of.
  template <class Visit>
  uint32_t visit_near(const Vec3& point, float radius, Visit&& visit) const;

  /// Calls visit(leaf) for each leaf of which some photon may be within reach of the point, in a fixed order. Returns
  /// how many photons these have room for.
  template <class Visit>
  uint32_t visit_leaves_near(const Vec3& point, Visit&& visit) const;

  /// Where the kBlock photons of a leaf are, seen from a ray.
  struct BesideRay {
    Floats distances2;  // squared distances from the ray, m^2; infinite before and behind the interval
    Floats places;      // along the ray, m
  };
  /// Calls visit(leaf, BesideRay), in a fixed order, for each leaf that holds a photon nearer than the radius, m, to
  /// the ray within the interval. Returns how many photons were looked at.
  template <class Visit>
  uint32_t visit_leaves_near_ray(const Ray& ray, const Interval& interval, float radius, Visit&& visit) const;

  /// Calls visit(number of a leaf) for each leaf of which some photon may be within reach of rays of the bundle.
  template <class Visit>
  void visit_leaves(const RayBundle& bundle, Visit&& visit) const {
    if (size_ > 0) boxes_.visit_leaves(bundle, visit);
  }
  const PhotonLeaf& leaf(uint32_t number) const { return leaves_[number]; }

  size_t size() const { return size_; }
  const Box& bounds() const { return bounds_; }  // of all photons
  size_t memory_bytes() const { return leaves_.capacity() * sizeof(PhotonLeaf) + boxes_.memory_bytes(); }

 private:
  size_t size_ = 0;
  std::vector<PhotonLeaf> leaves_;
  BoxTree boxes_;
  Box bounds_;
};

template <class Visit>
uint32_t MergeMap::visit_leaves_near(const Vec3& point, Visit&& visit) const {
  if (size_ == 0) return 0;
  uint32_t visited = 0;
  boxes_.visit_leaves(point, [&](uint32_t number) {
    visit(leaves_[number]);
    count(visited, kBlock);
  });
  return visited;
}

template <class Visit>
uint32_t MergeMap::visit_near(const Vec3& point, float radius, Visit&& visit) const {
  return visit_leaves_near(point, [&](const PhotonLeaf& leaf) {
    float distances2[kBlock], near2[kBlock];
    uint32_t near[kBlock];
    for (uint32_t i = 0; i < kBlock; ++i) {
      const float x = leaf.x[i] - point.x, y = leaf.y[i] - point.y, z = leaf.z[i] - point.z;
      distances2[i] = x * x + y * y + z * z;
    }
    const uint32_t found = append_below(distances2, kBlock, radius * radius, 0, near2, near);
    for (uint32_t i = 0; i < found; ++i) visit(leaf[near[i]], near2[i]);
  });
}

template <class Visit>
uint32_t MergeMap::visit_leaves_near_ray(const Ray& ray, const Interval& interval, float radius, Visit&& visit) const {
  if (size_ == 0) return 0;
  uint32_t visited = 0;
  boxes_.visit_leaves(ray, interval, [&](uint32_t number) {
    const PhotonLeaf& leaf = leaves_[number];
    const Floats3 offset = Floats3::of(leaf.x, leaf.y, leaf.z) - ray.origin;
    const Floats t = dot(offset, ray.direction);
    const Floats3 across = offset - t * ray.direction;
    const LaneMask beside_it = (t >= interval.t0) & (t < interval.t1);
    const BesideRay beside{select(beside_it, dot(across, across), kInfinity), t};
    if (any(beside.distances2 < radius * radius)) visit(leaf, beside);
    count(visited, kBlock);
  });
  return visited;
}

}  // namespace vpm
