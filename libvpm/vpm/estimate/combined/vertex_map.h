// Vertices of light sub-paths, found around points and beside rays, by their numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/base/below.h"
#include "vpm/base/count.h"
#include "vpm/photon/box_tree.h"

namespace vpm {

/// Finds positions within a radius: a hierarchy of boxes over leaves of up to kBlock positions.
class VertexMap {
 public:
  VertexMap() = default;
  /// Of the positions, m, numbered as they come; `radius` in m, > 0.
  VertexMap(const std::vector<Vec3>& positions, float radius);

  /// Calls visit(number, squared distance) for the positions nearer to the point than the radius, in a fixed order.
  /// Returns how many it computed the distance of.
  template <class Visit>
  uint32_t visit_near(const Vec3& point, Visit&& visit) const;
  /// The same with distances from a ray, for the positions whose projections onto it lie in the interval.
  template <class Visit>
  uint32_t visit_near_ray(const Ray& ray, const Interval& interval, Visit&& visit) const;

  size_t size() const { return size_; }
  float radius() const { return radius_; }
  size_t memory_bytes() const { return leaves_.capacity() * sizeof(Leaf) + boxes_.memory_bytes(); }

 private:
  /// Positions that a leaf lacks are infinite.
  struct alignas(64) Leaf {
    float x[kBlock], y[kBlock], z[kBlock];  // m
    uint32_t number[kBlock];
  };
  /// Shows the positions of a leaf that are nearer than the radius.
  template <class Visit>
  void use(const Leaf& leaf, const float* distances2, Visit&& visit) const;

  size_t size_ = 0;
  float radius_ = 0.0f;  // m
  std::vector<Leaf> leaves_;
  BoxTree boxes_;
};

template <class Visit>
void VertexMap::use(const Leaf& leaf, const float* distances2, Visit&& visit) const {
  uint32_t near[kBlock];
  float near2[kBlock];
  const uint32_t found = append_below(distances2, kBlock, radius_ * radius_, 0, near2, near);
  for (uint32_t i = 0; i < found; ++i) visit(leaf.number[near[i]], near2[i]);
}

template <class Visit>
uint32_t VertexMap::visit_near(const Vec3& point, Visit&& visit) const {
  if (size_ == 0) return 0;
  uint32_t visited = 0;
  boxes_.visit_leaves(point, [&](uint32_t number) {
    const Leaf& leaf = leaves_[number];
    float distances2[kBlock];
    for (uint32_t i = 0; i < kBlock; ++i) {
      const float x = leaf.x[i] - point.x, y = leaf.y[i] - point.y, z = leaf.z[i] - point.z;
      distances2[i] = x * x + y * y + z * z;
    }
    use(leaf, distances2, visit);
    count(visited, kBlock);
  });
  return visited;
}

template <class Visit>
uint32_t VertexMap::visit_near_ray(const Ray& ray, const Interval& interval, Visit&& visit) const {
  if (size_ == 0) return 0;
  uint32_t visited = 0;
  const Vec3 o = ray.origin, w = ray.direction;
  boxes_.visit_leaves(ray, interval, [&](uint32_t number) {
    const Leaf& leaf = leaves_[number];
    float distances2[kBlock];
    for (uint32_t i = 0; i < kBlock; ++i) {
      const float x = leaf.x[i] - o.x, y = leaf.y[i] - o.y, z = leaf.z[i] - o.z;
      const float t = x * w.x + y * w.y + z * w.z;
      const float across_x = x - t * w.x, across_y = y - t * w.y, across_z = z - t * w.z;
      const bool beside = t >= interval.t0 && t < interval.t1;
      const float across2 = across_x * across_x + across_y * across_y + across_z * across_z;
      distances2[i] = beside ? across2 : kInfinity;
    }
    use(leaf, distances2, visit);
    count(visited, kBlock);
  });
  return visited;
}

}  // namespace vpm
