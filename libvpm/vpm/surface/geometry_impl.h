// What a Geometry holds. Only this folder's .cpp files include this.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "vpm/surface/embree_tree.h"
#include "vpm/surface/few_triangles.h"
#include "vpm/surface/geometry.h"
#include "vpm/surface/locate.h"

namespace vpm {

constexpr uint32_t bit(Layer layer) { return static_cast<uint32_t>(layer); }
inline constexpr uint32_t kAllLayers = ~0u;

/// A sphere or a disc.
struct RoundShape {
  const ShapeData* data;  // of Geometry::Impl::shapes
  uint32_t shape, layer;
};

struct Geometry::Impl {
  std::deque<ShapeData> shapes;
  std::vector<double> areas;  // m^2
  std::vector<Box> bounds;
  Box around;  // all shapes, once committed
  std::vector<Layer> layers;
  EmbreeTree tree{shapes};
  float size = 0.0f;                          // m: of the box around all shapes, and its distance from the origin
  FewTriangles few;                           // all, if the scene is small
  std::vector<RoundShape> spheres_and_discs;  // likewise
  bool is_small = false;                      // all shapes are looked at for each ray
  bool committed = false;
  size_t bytes = 0;  // without the tree's

  /// How far beyond a hit one that coincides with it is looked for, m.
  float margin() const { return 0x1p-18f * size; }

  /// Does the ray lead away from the box around all shapes, outside of it? It meets nothing then.
  bool is_left_by(const Ray& ray) const {
    bool left = false;
    for (int axis = 0; axis < 3; ++axis)
      left |= ((ray.origin[axis] > around.hi[axis]) & (ray.direction[axis] >= 0.0f)) |
              ((ray.origin[axis] < around.lo[axis]) & (ray.direction[axis] <= 0.0f));
    return left;
  }

  /// Takes note of the shape that was added last, and says its number.
  uint32_t note(double area, const Box& box, Layer layer) {
    areas.push_back(area);
    bounds.push_back(box);
    layers.push_back(layer);
    size = std::max(size, glm::length(box.lo) + glm::length(box.hi));
    return static_cast<uint32_t>(shapes.size() - 1);
  }
  template <class S>
  uint32_t add_own(const S& shape, double area, Layer layer);
  void lay_out();
  void look_at_all(Query& query, uint32_t layers_seen) const;
};

}  // namespace vpm
