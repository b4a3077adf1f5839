// A density field on a regular lattice. It is stored in sparse bricks of 8^3 cells with bounds of the density, and can
// be looked up at points and walked along rays.
//
// A voxel's value sits AT its integer index coordinates (as in OpenVDB). Trilinear interpolation: the cell with lower
// corner (i, j, k) spans [i, i+1]^3. Nearest: the value of voxel (i, j, k) fills [i-1/2, i+1/2]^3. Stored values are
// dimensionless densities; a medium multiplies them by its coefficients per unit density.
#pragma once

#include <bit>
#include <cassert>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "vpm/base/vec.h"
#include "vpm/medium/grid/brick_boxes.h"
#include "vpm/medium/grid/density_stretch.h"

namespace vpm {

enum class Interpolation { trilinear, nearest };

/// The place of a grid in the world, its interpolation and the density around it.
struct GridFrame {
  Mat4d index_to_world{1.0};  // affine, invertible
  Vec3i lo{0}, hi{0};         // index box of the voxels with a value of their own, both ends included
  Interpolation interpolation = Interpolation::trilinear;
  float background = 0.0f;  // density outside the index box, >= 0
};

template <int spacing>
class LatticeWalk;

class DensityGrid {
 public:
  static constexpr int kCells = DensityStretch::kCells;
  static constexpr int kValues = DensityStretch::kValues;
  static constexpr int kCellBits = std::countr_zero(unsigned{kCells});
  static constexpr int kBrickValues = kValues * kValues * kValues;

  /// What a FillBrick has written: all values; the first alone, as all are equal; or none, as they are those of the
  /// brick that the same copy was called for before.
  enum class Filled { all, one, as_last };
  /// Writes the values of the voxels origin + (x, y, z), 0 <= x, y, z <= 8, to values[(z * 9 + y) * 9 + x]. All must be
  /// finite and >= 0. It is called from all threads, each of which has copies of its own.
  using FillBrick = std::function<Filled(const Vec3i& origin, float* values)>;
  /// Told in between, by one thread, that no voxel below `z` is asked for any more.
  using Passed = std::function<void(int z)>;

  /// Builds, on all threads, the bricks that cover the frame's index box and the reach of its interpolation. A brick
  /// with equal values stores one value only, and equal bricks store their values once. Where the voxels in the boxes
  /// of `occupied` take far fewer bricks, or all are more than one table may hold, these alone are stored: all others
  /// have the background's density. Throws InputError if the tables of bricks alone would take over 256 MiB.
  DensityGrid(const GridFrame& frame, const FillBrick& fill, const std::vector<IndexBox>& occupied = {},
              const Passed& passed = {});
  /// The same grid as the one that pack() has packed, which must come next. It reads its tables where they lie, in that
  /// memory, which it keeps.
  DensityGrid(TableUnpacker& packed, std::shared_ptr<const void> memory);
  /// Adds all that it is.
  void pack(TablePacker& packer) const;

  /// A ray in units of cells, from the lower corner of all bricks; its parameter is still in metres of the world.
  struct LatticeRay {
    Vec3d origin, direction;
  };
  [[gnu::always_inline]] LatticeRay lattice_ray(const Ray& ray) const {
    const auto [origin, direction] = to_index(ray);
    return {origin - lattice_lo_, direction};
  }
  /// Density at a point of a ray.
  [[gnu::always_inline]] float density(const LatticeRay& ray, double t) const {
    return density_at(ray.origin + t * ray.direction);
  }
  /// Densities at up to kAtOnce points of a ray: at t, t + step, ... (m). This is quicker than one by one, except where
  /// bricks lie in several boxes.
  void densities(const LatticeRay& ray, double t, double step, std::span<float> densities) const;
  static constexpr size_t kAtOnce = 16;
  /// Density at a point of the world.
  float density(const Vec3& world) const {
    return density_at(Vec3d(world_to_index_ * glm::dvec4(Vec3d(world), 1.0)) - lattice_lo_);
  }
  /// Is the density positive everywhere in a box of the world? Whole bricks decide: the answer may be no only because
  /// the density is zero outside the box, in a brick that the box reaches into.
  bool is_positive(const Box& world) const;
  /// The largest density in a box of index coordinates, or, where the box is larger than a few voxels, a bound: of any
  /// voxel that reaches into it, or in a brick that lies in it.
  float largest(const Vec3d& lo, const Vec3d& hi) const;
  /// The boxes of voxels, both ends included, of the bricks that hold any density above 0, in their order. Each voxel
  /// with one is in exactly one of them.
  std::vector<IndexBox> filled() const;
  /// Calls visit(const DensityPiece&) for the pieces of the ray, in order, until it returns false. Bricks of zero
  /// density are skipped. Returns the number of cells and uniform bricks that were read ("look-ups").
  template <class Visit>
  uint32_t visit_pieces(const Ray& ray, const Interval& interval, Visit&& visit) const;
  /// Calls visit(const DensityStretch&) for the segment of the ray in each brick, in order, until it returns false.
  /// Bricks of zero density are skipped. Returns the number of bricks whose bounds were read, including skipped ones.
  template <class Visit>
  uint32_t visit_majorants(const Ray& ray, const Interval& interval, Visit&& visit) const {
    return visit_majorants(
        ray, interval, [](double, float max) { return max == 0.0f; }, visit);
  }
  /// The same, but skips the segments for which passes(length, max) is true. That is quicker than visiting them.
  template <class Passes, class Visit>
  uint32_t visit_majorants(const Ray& ray, const Interval& interval, Passes&& passes, Visit&& visit) const;

  /// The part of the interval in which the density may differ from zero: all of it if the background is not zero.
  Interval clip(const Ray& ray, const Interval& interval) const;

  const GridFrame& frame() const { return frame_; }
  /// The box of index coordinates outside of which the density is the background density.
  Vec3d support_lo() const;
  Vec3d support_hi() const;
  /// The world-space box around the support.
  Box bounds() const;
  /// max_density() is the largest density, which bounds the interpolated field. mean_density() is the mean over the
  /// support, empty voxels included.
  float max_density() const { return max_density_; }
  double mean_density() const { return mean_density_; }
  /// The mean over the bricks that are stored. It says more than that over the support where a grid is far wider than
  /// what it holds; where all bricks are stored it is the same.
  double mean_of_stored() const { return mean_of_stored_; }
  /// How large what it holds is, m: the diagonal of its support, or, where not all bricks are stored, that of a cube of
  /// as much volume as they have.
  double extent() const;
  /// Shortest distance between neighbouring voxels, m.
  float voxel_size() const { return voxel_size_; }
  size_t memory_bytes() const;

 private:
  struct Brick {
    float min = 0.0f, max = 0.0f;  // over the brick's 9^3 values; if equal, nothing else is stored
    uint32_t first = 0;            // where its values begin, in units of kBrickValues; equal bricks have the same
    bool uniform() const { return min == max; }
  };

  /// Tables of a grid's own.
  struct Tables;

  /// A ray in index coordinates; its parameter is still in metres of the world.
  struct IndexRay {
    Vec3d origin, direction;
  };
  [[gnu::always_inline]] IndexRay to_index(const Ray& ray) const {
    return {Vec3d(world_to_index_ * glm::dvec4(Vec3d(ray.origin), 1.0)),
            Vec3d(world_to_index_ * glm::dvec4(Vec3d(ray.direction), 0.0))};
  }
  /// A grid without bricks.
  explicit DensityGrid(const GridFrame& frame);
  double lattice_shift() const { return frame_.interpolation == Interpolation::nearest ? 0.5 : 0.0; }
  /// The place at which a look-up reads.
  struct Place {
    float density;        // the result if `values` is null
    const float* values;  // of the voxels, from the cell's lower corner on; null: `density` is known
    Vec3 fraction;        // position within the cell, along each axis
  };
  /// Makes all bricks and returns the sum of the voxels' densities. The result is the same on any number of threads.
  double fill_bricks(const FillBrick& fill, const Passed& passed);
  /// The brick that has these values; `first` is not set yet.
  static Brick brick_of(const float* values);
  /// Sets walked_lo_ and walked_hi_.
  void find_walked();
  /// Is the density positive in all of these bricks of the lattice?
  bool bricks_are_positive(const IndexBox& bricks) const;
  /// The index coordinates of a brick's lower corner.
  Vec3i origin_of(size_t number) const { return (brick_lo_ + boxes_.of_number(number).brick(number)) * kCells; }
  /// The density at p, which for this and the following is in units of cells, from the lower corner of all bricks.
  float density_at(const Vec3d& p) const;
  /// The place of p, where boxes_ is whole().
  Place find(const Vec3d& p) const;
  /// The density at p where it is not. Not inline: loops of look-ups are quicker without a call to BrickBoxes::find().
  float density_in_boxes(const Vec3d& p) const;
  /// The largest value of the voxels from `first` to `last`, in index coordinates.
  float largest_of_voxels(const Vec3i& first, const Vec3i& last) const;
  /// densities() where boxes_ is whole().
  void densities_in_box(const LatticeRay& ray, double t, double step, std::span<float> densities) const;
  /// The place of p in the brick that holds it, with the cell that does.
  Place place_in(const Brick& brick, const Vec3d& p, const Vec3i& cell) const;
  /// The density at a place whose `values` are not null.
  float read(const Place& place) const;
  void cell_piece(const float* v, const Vec3& local, const Vec3& step, DensityPiece& piece) const;
  const float* values_of(const Brick& brick) const {
    return values_.data() + static_cast<size_t>(brick.first) * kBrickValues;
  }
  /// Calls inside(walk, t0, t1) for the segment of the ray in each brick, at whose number `walk` stands. If the
  /// background is not zero, calls outside(t0, t1) for the segments outside all bricks. Calls in order along the ray,
  /// until one returns false.
  template <class Inside, class Outside>
  void visit_bricks(const LatticeRay& ray, const Interval& interval, Inside&& inside, Outside&& outside) const;
  template <class Visit>
  bool visit_brick(const LatticeWalk<kCells>& at, const LatticeRay& ray, double t0, double t1, uint32_t& read,
                   Visit& visit) const;
  template <class Visit>
  bool visit_stretch(const Brick& brick, const Vec3d& corner, const LatticeRay& ray, double t0, double t1,
                     Visit& visit) const;

  GridFrame frame_;
  Mat4d world_to_index_{1.0};
  Vec3i brick_lo_{0}, brick_count_{0};         // in bricks
  Vec3d lattice_lo_{0.0}, lattice_size_{0.0};  // of all bricks: corner in index coordinates, and extent in cells
  // What walks are cut down to, in cells from the corner of the lattice: the box around the bricks that hold anything.
  // All of the lattice where there is a background, too.
  Vec3d walked_lo_{0.0}, walked_hi_{0.0};
  BrickBoxes boxes_{Vec3i(0)};  // of those that are stored, in bricks from the corner of the lattice
  std::span<const Brick> bricks_;
  std::span<const float> values_;
  std::span<const BrickBlocks> blocks_;  // of the same bricks
  std::shared_ptr<const void> memory_;   // in which these lie
  float max_density_ = 0.0f;
  double mean_of_stored_ = 0.0;
  double mean_density_ = 0.0;
  float voxel_size_ = 0.0f;
};

}  // namespace vpm

#include "vpm/medium/grid/density_grid_lookup.h"
#include "vpm/medium/grid/density_grid_walk.h"
