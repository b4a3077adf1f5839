// The shapes of a scene as Embree finds them, along rays and near points, and a ray's search among what it may meet.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <tuple>
#include <variant>

#include "vpm/surface/locate.h"

// Embree's own, so that its header is not needed here.
struct RTCDeviceTy;
struct RTCGeometryTy;
struct RTCSceneTy;

namespace vpm {

/// How much further than a distance Embree is to look, relative to it and to the scene's size, so that the rounding of
/// its own distances leaves nothing out: 64 times the spacing of floats in [1, 2).
inline constexpr float kBeyond = 0x1p-17f;

/// A ray's search for the nearest hit. Which hit that is is decided here, so that it is the same on any processor:
/// where Embree brings what the ray may meet, its own distances only say how far it looks. Of hits at one distance the
/// nearest is that of the shape added first.
struct Query {
  const Ray& ray;
  float t_max;                   // m
  float size;                    // m: of the scene and the ray's origin
  std::span<const Hit> without;  // their shapes are left out
  float limit;                   // m: how far Embree is to look, never more than before
  // The nearest so far:
  Crossing nearest{};
  float t = kInfinity;  // m: rounded, as distances are compared
  uint32_t shape = ~0u, triangle = 0;
  float others = kInfinity;  // m: no other shape is met before

  Query(const Ray& a_ray, float a_t_max, float scene_size, std::span<const Hit> left_out)
      : ray(a_ray),
        t_max(a_t_max),
        size(scene_size + std::abs(a_ray.origin.x) + std::abs(a_ray.origin.y) + std::abs(a_ray.origin.z)),
        without(left_out),
        limit(t_max + kBeyond * (t_max + size)) {}

  bool leaves_out(uint32_t candidate) const {
    for (const Hit& hit : without)
      if (hit.shape == candidate) return true;
    return false;
  }
  /// Takes a crossing if it is nearer than all before.
  bool take(const Crossing& met, uint32_t of_shape, uint32_t of_triangle) {
    const auto at = static_cast<float>(met.t);
    if (!(at >= kMinT)) return false;
    const bool nearer = at < t_max && std::tie(at, of_shape, of_triangle) < std::tie(t, shape, triangle);
    if (of_shape != shape) others = std::min(others, nearer ? t : at);
    if (!nearer) return false;
    nearest = met, t = at, shape = of_shape, triangle = of_triangle;
    // As far as what coincides with it may seem to be.
    limit = std::min(limit, t + kBeyond * (t + size) * std::abs(static_cast<float>(met.inverse_cosine)));
    return true;
  }
};

using ShapeData = std::variant<MeshShape, SphereShape, DiscShape>;

/// A tree over shapes, which it numbers in the order in which they are added. Failures of Embree itself (out of memory)
/// throw std::runtime_error.
class EmbreeTree {
 public:
  /// A deque, because Embree keeps pointers to its elements.
  explicit EmbreeTree(const std::deque<ShapeData>& shapes);
  ~EmbreeTree();
  EmbreeTree(const EmbreeTree&) = delete;
  EmbreeTree& operator=(const EmbreeTree&) = delete;

  /// Adds the shape that stands last. Of a mesh Embree copies positions and triangles, and the shape refers to these
  /// copies.
  void add(MeshShape& shape, std::span<const Vec3> positions, std::span<const glm::uvec3> triangles, Layer layer);
  void add(const SphereShape& shape, Layer layer);
  void add(const DiscShape& shape, Layer layer);
  void commit();

  /// Offers the query what its ray may meet of these layers (their bits).
  void look_along(Query& query, uint32_t layers) const;
  /// Does any shape come within `radius` (m) of a point?
  bool is_near(const Vec3& point, float radius) const;
  /// What Embree holds, with its copies of the shapes.
  size_t memory_bytes() const { return static_cast<size_t>(bytes_.load()); }

 private:
  template <class S>
  void add_own(const S& shape, Layer layer);
  void attach(RTCGeometryTy* geometry, Layer layer);
  void check() const;

  const std::deque<ShapeData>& shapes_;
  RTCDeviceTy* device_ = nullptr;
  RTCSceneTy* scene_ = nullptr;
  std::atomic<int64_t> bytes_{0};
  std::string error_;
};

}  // namespace vpm
