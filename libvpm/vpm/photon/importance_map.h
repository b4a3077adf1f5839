// How much light at a place matters to the picture: the importance that flows there, on a coarse grid over the scene.
#pragma once

#include <vector>

#include "vpm/photon/cube_grid.h"

namespace vpm {

/// Importance fluence in cubes over a box. It is the adjoint of radiant fluence, up to one factor for all cubes: where
/// the importance is twice as large, a photon contributes twice as much to the picture, on average over directions. A
/// place outside the box has the importance of the nearest cube.
class ImportanceMap {
 public:
  /// An empty map of `resolution` >= 1 cubes along the box's longest edge. The box has a volume.
  ImportanceMap(const Box& box, int resolution);

  /// Adds the importance `weight` (dimensionless, >= 0), which flows along the first `length` metres of the ray, > 0.
  void add_track(const Ray& ray, float length, float weight);
  /// Adds the tracks of a map of the same box and resolution.
  void merge(const ImportanceMap& other);
  /// Ends the collection: averages over neighbouring cubes, so that a few importons also count for the cubes around
  /// theirs, and raises every cube to at least a small fraction of the mean.
  void finish();

  /// The importance at a place, > 0 after finish().
  float at(const Vec3& p) const { return values_[grid_.number_at(p)]; }
  /// The distance along the ray at which the importance first exceeds `level`, m: just inside the first such cube. The
  /// cube of the ray's origin does not count. Infinite if there is none.
  float first_above(const Ray& ray, float level) const;
  size_t memory_bytes() const { return values_.size() * sizeof(float); }

 private:
  CubeGrid grid_;
  std::vector<float> values_;
};

}  // namespace vpm
