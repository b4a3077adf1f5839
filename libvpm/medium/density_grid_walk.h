// Walking a ray through a density grid: bricks first, then the cells of those that are not uniform. Included by
// density_grid.h only.
#pragma once

#include <utility>

#include "base/count.h"

namespace vpm {

/// Steps through a lattice of planes `spacing` apart along origin + t direction, from the cell that holds the point at
/// t0. Every plane is met at its own quotient, so that no error builds up along the way. The walk stays in the cells lo
/// to hi: whoever calls it knows where the ray leaves them, and rounding must not end it before.
class LatticeWalk {
 public:
  LatticeWalk(const Vec3d& origin, const Vec3d& direction, double spacing, double t0, const Vec3i& lo, const Vec3i& hi)
      : origin_(origin), spacing_(spacing) {
    for (int a = 0; a < 3; ++a) {
      cell_[a] = std::clamp(static_cast<int>(std::floor((origin[a] + t0 * direction[a]) / spacing)), lo[a], hi[a]);
      inverse_[a] = 1.0 / direction[a];
      step_[a] = direction[a] > 0.0 ? 1 : -1;
      last_[a] = direction[a] > 0.0 ? hi[a] : lo[a];
      meet_next_plane(a);
    }
  }
  const Vec3i& cell() const { return cell_; }
  /// Where the ray leaves the present cell.
  double exit() const { return std::min(exit_.x, std::min(exit_.y, exit_.z)); }
  void advance() {
    const int a = exit_.x <= exit_.y ? (exit_.x <= exit_.z ? 0 : 2) : (exit_.y <= exit_.z ? 1 : 2);
    cell_[a] += step_[a];
    meet_next_plane(a);
  }

 private:
  void meet_next_plane(int a) {
    const double plane = static_cast<double>(cell_[a] + (step_[a] > 0 ? 1 : 0)) * spacing_;
    const bool stays = cell_[a] == last_[a] || std::isinf(inverse_[a]);
    exit_[a] = stays ? std::numeric_limits<double>::infinity() : (plane - origin_[a]) * inverse_[a];
  }

  Vec3d origin_, inverse_, exit_;
  double spacing_;
  Vec3i cell_, step_, last_;
};

/// The part of [t0, t1] in which origin + t direction lies inside the box [lo, hi]; t0 >= t1 where there is none.
inline void clip_to_box(const Vec3d& origin, const Vec3d& direction, const Vec3d& lo, const Vec3d& hi, double& t0,
                        double& t1) {
  for (int a = 0; a < 3; ++a) {
    if (direction[a] == 0.0) {
      if (origin[a] < lo[a] || origin[a] > hi[a]) t1 = t0;
      continue;
    }
    const double near = (lo[a] - origin[a]) / direction[a];
    const double far = (hi[a] - origin[a]) / direction[a];
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
  LatticeWalk walk(inside, ray.direction, 1.0, t0, Vec3i(0), Vec3i(kCells - 1));
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
  LatticeWalk walk(origin, direction, kCells, t0, brick_lo_, brick_lo_ + brick_count_ - 1);
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
