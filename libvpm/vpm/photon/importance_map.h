// What light at a place is worth to the picture: the importance that flows there, on a coarse grid over the scene.
#pragma once

#include <vector>

#include "vpm/photon/cube_grid.h"

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
  float at(const Vec3& p) const { return values_[grid_.number_at(p)]; }
  /// How far along the ray the importance first exceeds `level`, m: just inside such a cube. Infinite where it never
  /// does; the cube of the origin does not count.
  float first_above(const Ray& ray, float level) const;
  size_t memory_bytes() const { return values_.size() * sizeof(float); }

 private:
  CubeGrid grid_;
  std::vector<float> values_;
};

}  // namespace vpm
