// Where light should fly from a place to be worth something: the directions that importance comes from, on a coarse
// grid over the scene.
#pragma once

#include <vector>

#include "vpm/base/rng.h"
#include "vpm/photon/cube_grid.h"

namespace vpm {

/// Cells of equal solid angle over the sphere of directions: those of a grid over the square of uniform_sphere().
struct DirectionCells {
  static constexpr int kRows = 8, kColumns = 16;
  static constexpr size_t kCount = size_t{kRows} * kColumns;

  static size_t of(const Vec3& direction);
  /// A direction uniform over the cell.
  static Vec3 sample(size_t cell, const Vec2& u);
};

/// The density over directions of travel at one place: constant in each cell.
class DirectionDensity {
 public:
  explicit DirectionDensity(const float* cumulative) : cumulative_(cumulative) {}

  /// Has anything told of this place? If not, there is nothing to ask.
  explicit operator bool() const { return cumulative_[DirectionCells::kCount - 1] > 0.0f; }
  float pdf(const Vec3& direction) const;  // 1/sr
  Vec3 sample(Rng& rng) const;

 private:
  const float* cumulative_;  // the probability of a cell and of all before it
};

/// In each cube of a box, how importance fluence is distributed over directions. Light that is worth something flies
/// against it.
class DirectionGuide {
 public:
  /// An empty guide of `resolution` >= 1 cubes along the box's longest edge. The box has a volume.
  DirectionGuide(const Box& box, int resolution);

  /// Adds importance `weight` (dimensionless, >= 0) that flows along `length` metres of the ray, > 0.
  void add_track(const Ray& ray, float length, float weight);
  /// Adds the tracks of a guide of the same box and resolution.
  void merge(const DirectionGuide& other);
  /// Ends the collecting: averages neighbours and makes densities. No direction needs a least density: who draws from
  /// these mixes them with a density of his own.
  void finish();

  /// The density at a place, after finish(). It lives as long as the guide.
  DirectionDensity at(const Vec3& p) const {
    return DirectionDensity(&values_[grid_.number_at(p) * DirectionCells::kCount]);
  }
  size_t memory_bytes() const { return values_.size() * sizeof(float); }

 private:
  CubeGrid grid_;
  std::vector<float> values_;  // by cube, then cell: importance; after finish() the cube's cumulative distribution
};

}  // namespace vpm
