// Walking a ray through a density grid: bricks first, then the cells of those that are not uniform. Included by
// density_grid.h only.
#pragma once

#include <utility>

#include "base/count.h"

namespace vpm {

/// Steps through a lattice of planes `spacing` apart along origin + t direction, from the cell that holds the point at
/// t0. Every plane is met at its own quotient, so that no error builds up along the way. The walk stays in the cells lo
/// to hi: whoever calls it knows where the ray leaves them, and rounding must not end it before.
///
/// No processor foresees which axis is next, and a wrong guess costs more than a step: all axes are dealt with at once,
/// in lanes that choose without branches, and where an axis meets its next plane but one is known before it is asked.
template <int spacing>
class LatticeWalk {
 public:
  LatticeWalk(const Vec3d& origin, const Vec3d& direction, double t0, const Vec3i& lo, const Vec3i& hi) {
    for (int a = 0; a < 3; ++a) {
      const bool up = direction[a] > 0.0;
      const auto plane = [&](int cell) { return static_cast<double>((cell + up) * spacing); };
      const double cell = std::floor((origin[a] + t0 * direction[a]) / spacing);
      cell_[a] = std::clamp(static_cast<int>(cell), lo[a], hi[a]);
      step_[a] = up ? 1 : -1;
      stride_[a] = up ? spacing : -spacing;
      plane_[a] = plane(static_cast<int>(cell_[a]));
      last_[a] = direction[a] == 0.0 ? plane_[a] : plane(up ? hi[a] : lo[a]);
      origin_[a] = origin[a];
      inverse_[a] = 1.0 / direction[a];
    }
    meet(exit_);
    plane_ += stride_;
    meet(next_);
  }
  Vec3i cell() const { return {cell_[0], cell_[1], cell_[2]}; }
  /// Where the ray leaves the present cell.
  double exit() const { return std::min(exit_[0], std::min(exit_[1], exit_[2])); }
  /// Goes on to the next cell: across an edge or a corner where the ray meets several planes at once.
  void advance() {
    const double leaves = exit();
    const Integers crosses = exit_ == Numbers{leaves, leaves, leaves, leaves};
    cell_ += crosses & step_;
    exit_ = crosses ? next_ : exit_;
    plane_ = crosses ? plane_ + stride_ : plane_;
    meet(next_);
  }

 private:
  // Lanes for x, y, z, and one of no meaning.
  using Numbers = double __attribute__((vector_size(32)));
  using Integers = int64_t __attribute__((vector_size(32)));

  /// Finds where the ray meets plane_: never where that is the last.
  void meet(Numbers& where) const {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    where = plane_ == last_ ? Numbers{kNever, kNever, kNever, kNever} : (plane_ - origin_) * inverse_;
  }

  Numbers origin_{}, inverse_{}, exit_{}, next_{};  // next_: where the planes behind those of exit_ are met
  Numbers plane_{}, last_{}, stride_{};             // plane_: that of next_
  Integers cell_{}, step_{};
};

/// The part of [t0, t1] in which origin + t direction lies inside the box [lo, hi]; t0 >= t1 where there is none.
inline void clip_to_box(const Vec3d& origin, const Vec3d& direction, const Vec3d& lo, const Vec3d& hi, double& t0,
                        double& t1) {
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

template <class Visit>
bool DensityGrid::visit_brick(const Vec3i& b, const IndexRay& ray, double t0, double t1, uint32_t& read,
                              Visit& visit) const {
  const Brick& brick_here = brick(b - brick_lo_);
  if (brick_here.max == 0.0f) return true;
  if (brick_here.uniform()) {
    count(read);
    return visit(DensityPiece{t0, t1, brick_here.min, 0.0, 0.0, 0.0});
  }
  const float* values = values_of(brick_here);
  const Vec3d inside = ray.origin - Vec3d(b * kCells);  // brick coordinates: 0 to 8
  LatticeWalk<1> walk(inside, ray.direction, t0, Vec3i(0), Vec3i(kCells - 1));
  const Vec3 step(ray.direction);
  for (double t = t0; t < t1; walk.advance()) {
    const double end = std::min(walk.exit(), t1);
    if (end > t) {
      DensityPiece piece;
      piece.t0 = t;
      piece.t1 = end;
      const Vec3i& cell = walk.cell();
      cell_piece(values, cell, Vec3(inside + t * ray.direction - Vec3d(cell)), step, piece);
      count(read);
      if (!visit(piece)) return false;
      t = end;
    }
  }
  return true;
}

template <class Inside, class Outside>
void DensityGrid::visit_bricks(const Ray& ray, const Interval& interval, Inside&& inside, Outside&& outside) const {
  IndexRay lattice_ray = to_index(ray);
  lattice_ray.origin += lattice_shift();
  const auto& [origin, direction] = lattice_ray;
  const Vec3d lo = Vec3d(brick_lo_ * kCells);
  const Vec3d hi = lo + Vec3d(brick_count_ * kCells);
  double t0 = interval.t0;
  double t1 = interval.t1;
  clip_to_box(origin, direction, lo, hi, t0, t1);
  const bool fills_outside = frame_.background > 0.0f;
  const auto beyond = [&](double a, double b) { return !fills_outside || !(b > a) || outside(a, b); };
  if (!(t1 > t0)) {
    beyond(interval.t0, interval.t1);
    return;
  }
  if (!beyond(interval.t0, t0)) return;
  LatticeWalk<kCells> walk(origin, direction, t0, brick_lo_, brick_lo_ + brick_count_ - 1);
  for (double t = t0; t < t1; walk.advance()) {
    const double end = std::min(walk.exit(), t1);
    if (end > t) {
      if (!inside(walk.cell(), lattice_ray, t, end)) return;
      t = end;
    }
  }
  beyond(t1, interval.t1);
}

template <class Visit>
uint32_t DensityGrid::visit_pieces(const Ray& ray, const Interval& interval, Visit&& visit) const {
  uint32_t read = 0;
  visit_bricks(
      ray, interval,
      [&](const Vec3i& b, const IndexRay& in, double t0, double t1) { return visit_brick(b, in, t0, t1, read, visit); },
      [&](double t0, double t1) {
        return visit(DensityPiece{t0, t1, frame_.background, 0.0, 0.0, 0.0});
      });
  return read;
}

template <class Visit>
uint32_t DensityGrid::visit_majorants(const Ray& ray, const Interval& interval, Visit&& visit) const {
  DensityStretch stretch;
  stretch.nearest = frame_.interpolation == Interpolation::nearest;
  uint32_t bricks = 0;
  const auto inside = [&](const Vec3i& b, const IndexRay& in, double t0, double t1) {
    count(bricks);
    const Brick& here = brick(b - brick_lo_);
    if (here.max == 0.0f) return true;
    stretch.t0 = t0;
    stretch.t1 = t1;
    stretch.min = here.min;
    stretch.max = here.max;
    stretch.values = here.uniform() ? nullptr : values_of(here);
    stretch.origin = in.origin - Vec3d(b * kCells);
    stretch.direction = in.direction;
    return static_cast<bool>(visit(std::as_const(stretch)));
  };
  const auto outside = [&](double t0, double t1) {
    return static_cast<bool>(visit(DensityStretch{t0, t1, frame_.background, frame_.background}));
  };
  visit_bricks(ray, interval, inside, outside);
  return bricks;
}

}  // namespace vpm
