// The shapes of a scene as Embree finds them: along rays and near points.
#pragma once

#include <atomic>
#include <deque>
#include <span>
#include <string>
#include <variant>

#include "vpm/surface/query.h"

// Embree's own, so that its header is not needed here.
struct RTCDeviceTy;
struct RTCGeometryTy;
struct RTCSceneTy;

namespace vpm {

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
