// Vertices of light sub-paths, found around points and beside rays, with what merges need to know of each.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/base/below.h"
#include "vpm/base/counters.h"
#include "vpm/photon/map/box_tree.h"
#include "vpm/photon/map/leaf_order.h"
#include "vpm/photon/map/ray_bundle.h"

namespace vpm {

/// A vertex to be sorted.
template <class Record>
struct PlacedRecord {
  Vec3 point{0.0f};  // m
  Record record;
};

/// The places of up to kBlock vertices, m; those that it lacks are infinite.
struct LeafPlaces {
  float x[kBlock], y[kBlock], z[kBlock];
};

/// Finds the vertices of a leaf that may be nearer to rays of the bundle than the radius, m: their numbers, for which
/// there is to be room for kBlock. Returns how many there are.
inline uint32_t find_near(const LeafPlaces& leaf, const RayBundle& bundle, float radius, uint32_t* numbers) {
  const HalfSpaces& region = bundle.region();
  const float reach = 1.0001f * radius;  // for rounding
  const Floats3 places = Floats3::of(leaf.x, leaf.y, leaf.z) - bundle.apex();
  LaneMask near = -1;
  for (int k = 0; k < region.count(); ++k) near &= dot(region.normal(k), places) >= region.offset(k) - reach;
  return store_numbers(0, bits_of(near), numbers);
}

/// Finds vertices within a radius: a hierarchy of boxes over leaves. A leaf is LeafPlaces with records of the type
/// Leaf::Record, which set() puts in and operator[] takes out.
template <class Leaf>
class VertexMap {
 public:
  VertexMap() = default;
  /// Of these vertices, for radii of up to `reach`, m, > 0.
  VertexMap(const std::vector<PlacedRecord<typename Leaf::Record>>& vertices, float reach);

  /// Calls visit(record, squared distance) for the vertices nearer to the point than the radius, in a fixed order.
  /// Returns how many it computed the distance of.
  template <class Visit>
  uint32_t visit_near(const Vec3& point, float radius, Visit&& visit) const;

  /// Calls visit(leaf) for each leaf of which some vertex may be within reach of the point, in a fixed order. Returns
  /// how many vertices these have room for.
  template <class Visit>
  uint32_t visit_leaves_near(const Vec3& point, Visit&& visit) const;

  /// How the kBlock vertices of a leaf lie to a ray.
  struct BesideRay {
    Floats distances2;  // squared distances from the ray, m^2; infinite beside its ends
    Floats places;      // along the ray, m
  };
  /// Calls visit(leaf, BesideRay) for each leaf of which some vertex may be nearer to the ray than the radius, at a
  /// place in the interval, m, in a fixed order. Returns how many vertices these have room for.
  template <class Visit>
  uint32_t visit_leaves_near_ray(const Ray& ray, const Interval& interval, float radius, Visit&& visit) const;

  /// Calls visit(number of a leaf) for each leaf of which some vertex may be within reach of rays of the bundle.
  template <class Visit>
  void visit_leaves(const RayBundle& bundle, Visit&& visit) const {
    if (size_ > 0) boxes_.visit_leaves(bundle, visit);
  }
  const Leaf& leaf(uint32_t number) const { return leaves_[number]; }

  size_t size() const { return size_; }
  const Box& bounds() const { return bounds_; }  // of all vertices
  size_t memory_bytes() const { return leaves_.capacity() * sizeof(Leaf) + boxes_.memory_bytes(); }

 private:
  size_t size_ = 0;
  std::vector<Leaf> leaves_;
  BoxTree boxes_;
  Box bounds_;
};

template <class Leaf>
VertexMap<Leaf>::VertexMap(const std::vector<PlacedRecord<typename Leaf::Record>>& vertices, float reach)
    : size_(vertices.size()) {
  if (vertices.empty()) return;
  std::vector<Vec3> positions;
  positions.reserve(size_);
  for (const auto& vertex : vertices) positions.push_back(vertex.point);
  const LeafOrder tree = sort_into_leaves(positions, kBlock);
  leaves_.resize(tree.leaves);
  for (const Vec3& position : positions) bounds_.add(position);
  boxes_ = BoxTree(tree.leaves, [&](size_t number) {
    const size_t begin = leaf_begin(size_, tree.leaves, number), end = leaf_begin(size_, tree.leaves, number + 1);
    Leaf& leaf = leaves_[number];
    Box box;
    for (size_t i = 0; i < kBlock; ++i) {
      const bool there = begin + i < end;
      const Vec3 p = there ? positions[tree.order[begin + i]] : Vec3(kInfinity);
      leaf.x[i] = p.x;
      leaf.y[i] = p.y;
      leaf.z[i] = p.z;
      leaf.set(i, there ? vertices[tree.order[begin + i]].record : typename Leaf::Record());
      if (there) box.add(p);
    }
    const float margin = 1.0001f * reach;  // for rounding
    return Box{box.lo - margin, box.hi + margin};
  });
}

template <class Leaf>
template <class Visit>
uint32_t VertexMap<Leaf>::visit_leaves_near(const Vec3& point, Visit&& visit) const {
  if (size_ == 0) return 0;
  uint32_t visited = 0;
  boxes_.visit_leaves(point, [&](uint32_t number) {
    visit(leaves_[number]);
    count(visited, kBlock);
  });
  return visited;
}

template <class Leaf>
template <class Visit>
uint32_t VertexMap<Leaf>::visit_near(const Vec3& point, float radius, Visit&& visit) const {
  return visit_leaves_near(point, [&](const Leaf& leaf) {
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

template <class Leaf>
template <class Visit>
uint32_t VertexMap<Leaf>::visit_leaves_near_ray(const Ray& ray, const Interval& interval, float radius,
                                                Visit&& visit) const {
  if (size_ == 0) return 0;
  uint32_t visited = 0;
  boxes_.visit_leaves(ray, interval, [&](uint32_t number) {
    const Leaf& leaf = leaves_[number];
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
