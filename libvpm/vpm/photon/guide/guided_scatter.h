// Guided scattering of photons: the directions in which light from a place matters to the picture, on a coarse grid
// over the scene. Nine tenths of the photons scatter as the medium or surface says, one tenth into those directions.
#pragma once

#include <vector>

#include "vpm/base/rng.h"
#include "vpm/path/walk.h"
#include "vpm/photon/guide/cube_grid.h"

namespace vpm {

/// Cells of equal solid angle over the sphere of directions: uniform_sphere() maps a grid over its unit square to them.
struct DirectionCells {
  static constexpr int kRows = 8, kColumns = 16;
  static constexpr size_t kCount = size_t{kRows} * kColumns;

  static size_t of(const Vec3& direction);
  /// A direction uniform over the cell.
  static Vec3 sample(size_t cell, const Vec2& u);
};

/// The density over directions of travel at one place. It is constant in each cell.
class DirectionDensity {
 public:
  explicit DirectionDensity(const float* cumulative) : cumulative_(cumulative) {}

  /// Is anything known of this place? If not, pdf() and sample() must not be called.
  explicit operator bool() const { return cumulative_[DirectionCells::kCount - 1] > 0.0f; }
  float pdf(const Vec3& direction) const;  // 1/sr
  Vec3 sample(Rng& rng) const;

 private:
  const float* cumulative_;  // the probability of each cell and of all cells before it
};

/// The distribution of importance fluence over directions, in each cube of a box. Light that matters to the picture
/// travels against the direction in which importance flows.
class DirectionGuide {
 public:
  /// An empty guide of `resolution` >= 1 cubes along the box's longest edge. The box has a volume.
  DirectionGuide(const Box& box, int resolution);

  /// Adds the importance `weight` (dimensionless, >= 0), which flows along the first `length` metres of the ray, > 0.
  void add_track(const Ray& ray, float length, float weight);
  /// Adds the tracks of a guide of the same box and resolution.
  void merge(const DirectionGuide& other);
  /// Ends the collection: averages over neighbouring cubes and computes densities. A density may be zero for some
  /// directions, because callers mix it with another one.
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

/// scatter_in_medium() with guided directions. Directions are drawn from a mixture of the medium's density and the
/// guide's. The power is multiplied by the medium's density over that of the mixture, at most 10 / 9
/// [Veach1997, sec. 9.2.4]. This factor has the mean 1, like Russian roulette. The guide does not change absorption.
bool scatter_in_medium(const DirectionGuide& guide, const MediumProperties& here, PathState& state, Rng& rng);

/// scatter_at_surface() with guided directions, in the same way; Scatter::weight contains the factor. Specular surfaces
/// are not guided. Russian roulette ignores the guide: otherwise it would end those photons that the guide wants most,
/// whose powers are low because there are many of them.
bool scatter_at_surface(const DirectionGuide& guide, const Scene& scene, const Hit& hit, PathState& state, Rng& rng,
                        Scatter& scatter);

}  // namespace vpm
