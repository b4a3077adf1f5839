// Vertices of light sub-paths, found around points and beside rays, with what merges need to know of each.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/base/below.h"
#include "vpm/base/count.h"
#include "vpm/photon/box_tree.h"
#include "vpm/photon/leaf_order.h"

namespace vpm {

/// A vertex to be sorted.
template <class Record>
struct PlacedRecord {
  Vec3 point{0.0f};  // m
  Record record;
};

/// Finds vertices within a radius: a hierarchy of boxes over leaves of up to kBlock of them, whose records lie in the
/// order of the leaves.
template <class Record>
class VertexMap {
 public:
  VertexMap() = default;
  /// Of these vertices, for radii of up to `reach`, m, > 0.
  VertexMap(const std::vector<PlacedRecord<Record>>& vertices, float reach);

  /// Calls visit(record, squared distance) for the vertices nearer to the point than the radius, in a fixed order.
  /// Returns how many it computed the distance of.
  template <class Visit>
  uint32_t visit_near(const Vec3& point, float radius, Visit&& visit) const;
  /// Calls visit(record, squared distance from the ray, place along it) for those nearer to the ray than the radius
  /// whose places along it, m, lie in the interval.
  template <class Visit>
  uint32_t visit_near_ray(const Ray& ray, const Interval& interval, float radius, Visit&& visit) const;

  size_t size() const { return size_; }
  size_t memory_bytes() const {
    return leaves_.capacity() * sizeof(Leaf) + records_.capacity() * sizeof(Record) + boxes_.memory_bytes();
  }

 private:
  /// Positions that a leaf lacks are infinite.
  struct alignas(64) Leaf {
    float x[kBlock], y[kBlock], z[kBlock];  // m
  };

  size_t size_ = 0;
  std::vector<Leaf> leaves_;
  std::vector<Record> records_;  // kBlock for each leaf
  BoxTree boxes_;
};

template <class Record>
VertexMap<Record>::VertexMap(const std::vector<PlacedRecord<Record>>& vertices, float reach) : size_(vertices.size()) {
  if (vertices.empty()) return;
  std::vector<Vec3> positions;
  positions.reserve(size_);
  for (const PlacedRecord<Record>& vertex : vertices) positions.push_back(vertex.point);
  const LeafOrder tree = sort_into_leaves(positions, kBlock);
  leaves_.resize(tree.leaves);
  records_.resize(tree.leaves * kBlock);
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
      if (!there) continue;
      box.add(p);
      records_[number * kBlock + i] = vertices[tree.order[begin + i]].record;
    }
    const float margin = 1.0001f * reach;  // for rounding
    return Box{box.lo - margin, box.hi + margin};
  });
}

template <class Record>
template <class Visit>
uint32_t VertexMap<Record>::visit_near(const Vec3& point, float radius, Visit&& visit) const {
  if (size_ == 0) return 0;
  uint32_t visited = 0;
  boxes_.visit_leaves(point, [&](uint32_t number) {
    const Leaf& leaf = leaves_[number];
    float distances2[kBlock], near2[kBlock];
    uint32_t near[kBlock];
    for (uint32_t i = 0; i < kBlock; ++i) {
      const float x = leaf.x[i] - point.x, y = leaf.y[i] - point.y, z = leaf.z[i] - point.z;
      distances2[i] = x * x + y * y + z * z;
    }
    const uint32_t found = append_below(distances2, kBlock, radius * radius, 0, near2, near);
    for (uint32_t i = 0; i < found; ++i) visit(records_[number * kBlock + near[i]], near2[i]);
    count(visited, kBlock);
  });
  return visited;
}

template <class Record>
template <class Visit>
uint32_t VertexMap<Record>::visit_near_ray(const Ray& ray, const Interval& interval, float radius,
                                           Visit&& visit) const {
  if (size_ == 0) return 0;
  uint32_t visited = 0;
  const Vec3 o = ray.origin, w = ray.direction;
  const float t0 = interval.t0, t1 = interval.t1;
  boxes_.visit_leaves(ray, interval, [&, o, w, t0, t1](uint32_t number) {
    const Leaf& leaf = leaves_[number];
    float distances2[kBlock], places[kBlock], near2[kBlock];
    uint32_t near[kBlock];
    for (uint32_t i = 0; i < kBlock; ++i) {
      const float x = leaf.x[i] - o.x, y = leaf.y[i] - o.y, z = leaf.z[i] - o.z;
      const float t = x * w.x + y * w.y + z * w.z;
      const float across_x = x - t * w.x, across_y = y - t * w.y, across_z = z - t * w.z;
      const float across2 = across_x * across_x + across_y * across_y + across_z * across_z;
      places[i] = t;
      distances2[i] = (t >= t0) & (t < t1) ? across2 : kInfinity;
    }
    const uint32_t found = append_below(distances2, kBlock, radius * radius, 0, near2, near);
    for (uint32_t i = 0; i < found; ++i) visit(records_[number * kBlock + near[i]], near2[i], places[near[i]]);
    count(visited, kBlock);
  });
  return visited;
}

}  // namespace vpm
