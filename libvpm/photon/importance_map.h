// What light at a place is worth to the picture: the importance that flows there, on a coarse grid over the scene.
#pragma once

#include <cstdint>
#include <vector>

#include "medium/distance/strategy.h"
#include "scene/scene.h"

namespace vpm {

/// Importance fluence in cubes over a box: the adjoint of radiant fluence, up to one factor for all cubes. A photon of
/// twice the importance is twice as much worth to the picture, on average over directions. Outside the box counts the
/// nearest cube.
class ImportanceMap {
 public:
  /// An empty map of `resolution` >= 1 cubes along the box's longest edge. The box has a volume.
  ImportanceMap(const Box& box, int resolution);

  /// Adds importance `weight` (dimensionless, >= 0) that flows along `length` metres of the ray, > 0.
  void add_track(const Ray& ray, float length, float weight);
  /// Adds the tracks of a map of the same box and resolution.
  void merge(const ImportanceMap& other);
  /// Ends the collecting: averages neighbours, so that a few importons tell of the cubes around theirs, and lifts what
  /// is left dark to a small part of the mean.
  void finish();

  /// The importance at a place, > 0 after finish().
  float at(const Vec3& p) const { return values_[number(cube_at(p))]; }
  /// How far along the ray the importance first exceeds `level`, m: just inside such a cube. Infinite where it never
  /// does; the cube of the origin does not count.
  float first_above(const Ray& ray, float level) const;
  size_t memory_bytes() const { return values_.size() * sizeof(float); }

 private:
  Vec3i cube_at(const Vec3& p) const;
  size_t number(const Vec3i& cube) const {
    return (static_cast<size_t>(cube.z) * static_cast<size_t>(size_.y) + static_cast<size_t>(cube.y)) *
               static_cast<size_t>(size_.x) +
           static_cast<size_t>(cube.x);
  }
  /// Calls visit(number, entered, left), distances in metres, for each cube that the first `length` metres of the ray
  /// cross, until it returns false.
  template <class Visit>
  void visit_cubes(const Ray& ray, float length, Visit&& visit) const;
  void average_along(int axis);

  Box box_;
  Vec3i size_{1};      // cubes along each axis
  float edge_ = 1.0f;  // of a cube, m
  std::vector<float> values_;
};

/// Importons from the camera [Peter1998, sec. 3]: eye paths, one from a random pixel each, that fly, scatter and are
/// absorbed as light would be, with radiance's factors. Each adds its tracks. `count` >= 1; a pure function of seed,
/// pass and count.
ImportanceMap trace_importons(const Scene& scene, const DistanceStrategy& strategy, uint64_t seed, uint64_t pass,
                              uint64_t count, int max_events);

}  // namespace vpm
