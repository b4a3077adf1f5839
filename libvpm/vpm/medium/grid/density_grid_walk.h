// The walk of a ray through a density grid: over bricks, and within a brick that is not uniform over its cells.
// density_grid.h includes this file at its end; include that one.
#pragma once

#include <utility>

#include "vpm/base/counters.h"
#include "vpm/medium/grid/density_grid.h"

namespace vpm {

/// Steps through a lattice of planes `spacing` apart along origin + t direction, from the cell that holds the point at
/// t0. The t of every plane is computed from the plane's own position, so that no error builds up along the way. It is
/// the t that clip_to_box() computes: a walk that ends where the ray leaves the cells lo to hi stays in them.
///
/// Branch prediction cannot foresee which axis is next, and a wrong guess costs more than a step. All axes are
/// therefore handled at once, by masks instead of branches. The t at which an axis meets the plane after its next one
/// is computed a step ahead. Each axis has its own registers, so that no step waits for a shuffle of lanes.
template <int spacing>
class LatticeWalk {
 public:
  /// The cell `lo` has number `first`. From one cell to the next along an axis the number grows by that axis's
  /// `strides`.
  LatticeWalk(const Vec3d& origin, const Vec3d& direction, double t0, const Vec3i& lo, const Vec3i& hi,
              const Vec3i& strides, size_t first = 0) {
    for (int a = 0; a < 3; ++a) axes_[a] = Axis(origin[a], direction[a], t0, lo[a], hi[a], strides[a]);
    number_ = axes_[0].number + axes_[1].number + axes_[2].number + both(static_cast<int64_t>(first));
  }
  /// The number of the present cell.
  int64_t number() const { return number_[0]; }
  /// The lower corner of the present cell.
  Vec3d corner() const { return {axes_[0].corner(), axes_[1].corner(), axes_[2].corner()}; }
  /// The t at which the ray leaves the present cell.
  double exit() const { return nearest_exit()[0]; }
  /// Goes on to the next cell. If the ray meets several planes at once, that is across an edge or a corner.
  void advance() {
    const Double at = nearest_exit();
    number_ += axes_[0].cross_at(at) + axes_[1].cross_at(at) + axes_[2].cross_at(at);
  }

 private:
  // Vector types, because their comparisons give masks; both lanes hold the same.
  using Double = double __attribute__((vector_size(16)));
  using Integer = int64_t __attribute__((vector_size(16)));
  static Double both(double x) { return Double{x, x}; }
  static Integer both(int64_t x) { return Integer{x, x}; }
  static Double least(const Double& a, const Double& b) { return a < b ? a : b; }

  struct Axis {
    Axis() = default;
    Axis(double from, double along, double t0, int lo, int hi, int64_t per_cell) {
      const bool up = along > 0.0;
      const int64_t cell = std::clamp(static_cast<int>(std::floor((from + t0 * along) / spacing)), lo, hi);
      number = both((cell - lo) * per_cell);
      step = both(up ? per_cell : -per_cell);
      stride = both(up ? double{spacing} : -double{spacing});
      to_corner = up ? -2.0 * spacing : double{spacing};
      origin = both(from);
      inverse = both(1.0 / along);
      if (!std::isfinite(inverse[0])) {  // meets no plane ever
        origin = both(-std::numeric_limits<double>::infinity());
        inverse = both(1.0);
      }
      plane = both(static_cast<double>(cell + up) * spacing);
      exit = (plane - origin) * inverse;
      plane += stride;
      next = (plane - origin) * inverse;
    }
    double corner() const { return plane[0] + to_corner; }
    /// Goes on to the next cell if the ray leaves this one at `at`. Returns by how much the cell's number grows.
    Integer cross_at(const Double& at) {
      const Integer crosses = exit == at;
      exit = Double((crosses & Integer(next)) | (~crosses & Integer(exit)));
      plane += Double(crosses & Integer(stride));
      next = (plane - origin) * inverse;
      return crosses & step;
    }

    Double exit{}, next{};  // t of the plane by which the ray leaves the cell, and of the one after it
    Double plane{};         // position of the one after it
    Double origin{}, inverse{}, stride{};
    Integer number{}, step{};  // what the first cell's number owes to this axis, and what a step adds to it
    double to_corner = 0.0;    // from `plane` to the cell's lower end
  };

  Double nearest_exit() const { return least(axes_[0].exit, least(axes_[1].exit, axes_[2].exit)); }

  Axis axes_[3];
  Integer number_{};
};

/// Cuts [t0, t1] down to the part in which origin + t direction lies inside the box [lo, hi]; t0 >= t1 if there is
/// none.
[[gnu::always_inline]] inline void clip_to_box(const Vec3d& origin, const Vec3d& direction, const Vec3d& lo,
                                               const Vec3d& hi, double& t0, double& t1) {
  for (int a = 0; a < 3; ++a) {
    if (direction[a] == 0.0) {
      if (origin[a] < lo[a] || origin[a] > hi[a]) t1 = t0;
      continue;
    }
    const double inverse = 1.0 / direction[a];
    const double near = (lo[a] - origin[a]) * inverse;
    const double far = (hi[a] - origin[a]) * inverse;
    t0 = std::max(t0, std::min(near, far));
    t1 = std::min(t1, std::max(near, far));
  }
}

template <class Inside, class Outside>
void DensityGrid::visit_bricks(const LatticeRay& ray, const Interval& interval, Inside&& inside,
                               Outside&& outside) const {
  double t0 = interval.t0;
  double t1 = interval.t1;
  clip_to_box(ray.origin, ray.direction, walked_lo_, walked_hi_, t0, t1);
  const bool fills_outside = frame_.background > 0.0f;
  const auto beyond = [&](double a, double b) { return !fills_outside || !(b > a) || outside(a, b); };
  if (!(t1 > t0)) {
    beyond(interval.t0, interval.t1);
    return;
  }
  const auto walk_box = [&](const BrickBox& box, double from, double to) {
    LatticeWalk<kCells> walk(ray.origin, ray.direction, from, box.lo, box.lo + box.count - 1, box.strides(), box.first);
    for (double t = from; t < to; walk.advance()) {
      const double end = std::min(walk.exit(), to);
      if (end > t) {
        if (!inside(walk, t, end)) return false;
        t = end;
      }
    }
    return true;
  };
  if (boxes_.whole()) [[likely]] {
    if (beyond(interval.t0, t0) && walk_box(boxes_.all().front(), t0, t1)) beyond(t1, interval.t1);
    return;
  }
  double done = interval.t0;
  const bool all =
      boxes_.visit(ray.origin / double{kCells}, ray.direction / double{kCells}, t0, t1, [&](const BrickBox& box) {
        double from = t0, to = t1;
        clip_to_box(ray.origin, ray.direction, Vec3d(box.lo) * double{kCells},
                    Vec3d(box.lo + box.count) * double{kCells}, from, to);
        if (!(to > from)) return true;
        if (!beyond(done, from)) return false;
        done = to;
        return walk_box(box, from, to);
      });
  if (all) beyond(done, interval.t1);
}

template <class Visit>
bool DensityGrid::visit_brick(const LatticeWalk<kCells>& at, const LatticeRay& ray, double t0, double t1,
                              uint32_t& read, Visit& visit) const {
  const Brick& brick = bricks_[at.number()];
  if (brick.max == 0.0f) return true;
  if (brick.uniform()) {
    count(read);
    return visit(DensityPiece{t0, t1, brick.min, 0.0, 0.0, 0.0});
  }
  const float* values = values_of(brick);
  // A ray reads most of a brick's cache lines, in an order that hardware does not predict: all are prefetched.
  constexpr int kLine = 64 / sizeof(float);
  for (int i = 0; i < kBrickValues; i += kLine) __builtin_prefetch(values + i);
  const Vec3i lo(at.corner());
  LatticeWalk<1> walk(ray.origin, ray.direction, t0, lo, lo + (kCells - 1), {1, kValues, kValues * kValues});
  const Vec3 step(ray.direction);
  for (double t = t0; t < t1; walk.advance()) {
    const double end = std::min(walk.exit(), t1);
    if (end > t) {
      DensityPiece piece;
      piece.t0 = t;
      piece.t1 = end;
      cell_piece(values + walk.number(), Vec3(ray.origin + t * ray.direction - walk.corner()), step, piece);
      count(read);
      if (!visit(piece)) return false;
      t = end;
    }
  }
  return true;
}

template <class Visit>
uint32_t DensityGrid::visit_pieces(const Ray& ray, const Interval& interval, Visit&& visit) const {
  uint32_t read = 0;
  const LatticeRay in = lattice_ray(ray);
  visit_bricks(
      in, interval,
      [&](const LatticeWalk<kCells>& walk, double t0, double t1) { return visit_brick(walk, in, t0, t1, read, visit); },
      [&](double t0, double t1) {
        return visit(DensityPiece{t0, t1, frame_.background, 0.0, 0.0, 0.0});
      });
  return read;
}

template <class Passes, class Visit>
uint32_t DensityGrid::visit_majorants(const Ray& ray, const Interval& interval, Passes&& passes, Visit&& visit) const {
  uint32_t bricks = 0;
  const LatticeRay in = lattice_ray(ray);
  visit_bricks(
      in, interval,
      [&](const LatticeWalk<kCells>& walk, double t0, double t1) {
        count(bricks);
        const Brick& brick = bricks_[walk.number()];
        return passes(t1 - t0, brick.max) || visit_stretch(brick, walk.corner(), in, t0, t1, visit);
      },
      [&](double t0, double t1) {
        return passes(t1 - t0, frame_.background) ||
               visit(DensityStretch{t0, t1, frame_.background, frame_.background});
      });
  return bricks;
}

// Kept out of the walk's loop (noinline), so that the walk keeps its registers while segments are skipped.
template <class Visit>
[[gnu::noinline]] bool DensityGrid::visit_stretch(const Brick& brick, const Vec3d& corner, const LatticeRay& ray,
                                                  double t0, double t1, Visit& visit) const {
  DensityStretch stretch{t0, t1, brick.min, brick.max};
  if (!brick.uniform()) {
    stretch.values = values_of(brick);
    stretch.blocks = &blocks_[brick.first];
    __builtin_prefetch(stretch.blocks);
    stretch.origin = ray.origin - corner;
    stretch.direction = ray.direction;
    stretch.nearest = frame_.interpolation == Interpolation::nearest;
  }
  return visit(std::as_const(stretch));
}

}  // namespace vpm
