// The places where a medium emits, for drawing some of them: cells of a lattice, each with a bound of what is emitted
// in it. Like that the drawn places, and their density along lines, are exact and quick for any source.
#pragma once

#include <memory>
#include <vector>

#include "vpm/base/vec.h"
#include "vpm/medium/medium.h"

namespace vpm {

class EmittingVolume {
 public:
  /// Of a medium that emits, in boxes, m, as far as these are known. The cells are those of the grid of its source,
  /// else of its density, that reach into the boxes; without either, the box around all, or small ones where that would
  /// be mostly empty. Throws InputError where nothing is emitted anywhere.
  EmittingVolume(const Medium& medium, const std::vector<Box>& around);

  /// What would be emitted if the medium filled all cells, W: by Gauss points along each axis of each cell, two, which
  /// is exact for products of two trilinear fields on one lattice if cells are its own, and four where temperatures
  /// emit much.
  const Rgb& power() const { return power_; }
  /// 4 pi times the integral of the bound, W.
  double bound() const { return 4.0 * kPiD * total_; }

  struct Place {
    Vec3 position{0.0f};  // m
    double bound = 0.0;   // of the mean of the channels' emission coefficients there, W/(m^3 sr)
    double rest = 0.0;    // of the number that chose the cell: uniform in [0, 1), independent of the position
  };
  /// A place drawn with density proportional to the bound, from four uniform numbers.
  Place draw(double choice, double x, const Vec2& yz) const;
  /// The density with which draw() finds a place in that direction from a ray's origin, 1/sr: the integral of its
  /// density along the ray times the distance squared.
  double direction_density(const Ray& ray) const;

  Box bounds() const { return bounds_->bounds(); }
  bool grey() const { return grey_; }
  size_t memory_bytes() const { return bounds_->memory_bytes() + cells_.size() * sizeof(Cell); }

 private:
  struct Cell {
    Vec3i voxel{0};
    double before = 0.0;  // the integral of the bound over the cells before it, W/sr
  };
  void add_cells();
  Rgbd power_in(const Medium& medium, const Vec3i& voxel) const;
  Vec3d to_world(const Vec3d& index) const { return Vec3d(bounds_->frame().index_to_world * glm::dvec4(index, 1.0)); }

  std::shared_ptr<const DensityGrid> bounds_;  // of cells, each a voxel that fills it
  std::vector<Cell> cells_;                    // those that emit, in their order
  double total_ = 0.0, volume_ = 0.0;          // W/sr; m^3 of a cell
  Rgb power_{0.0f};
  bool grey_ = false;
};

}  // namespace vpm
