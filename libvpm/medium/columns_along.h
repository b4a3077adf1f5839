// The column and the density at many places of one ray, in any order, after one walk along it.
#pragma once

#include <algorithm>
#include <vector>

#include "medium/medium.h"

namespace vpm {

/// What a medium puts before each place of a stretch of a ray. Keeps its buffer between rays: one for each thread.
class ColumnsAlong {
 public:
  /// Walks the medium along the interval, which is finite unless the medium is homogeneous; `medium` null: empty space.
  /// Returns the look-ups made.
  uint32_t walk(const Medium* medium, const Ray& ray, const Interval& interval) {
    pieces_.clear();
    double before = 0.0;
    uint32_t lookups = 0;
    if (medium)
      lookups = medium->visit_pieces(ray, interval, [&](const DensityPiece& piece) {
        pieces_.push_back({piece, before});
        before += piece.column();
        return true;
      });
    return lookups;
  }

  struct Place {
    double column;   // m, from the interval's start to here
    double density;  // here
  };
  /// At the distance `t`, m, of the interval.
  Place at(double t) const {
    const auto after =
        std::upper_bound(pieces_.begin(), pieces_.end(), t, [](double x, const Before& b) { return x < b.piece.t0; });
    if (after == pieces_.begin()) return {0.0, 0.0};
    const auto& [piece, column] = *(after - 1);
    if (t > piece.t1) return {column + piece.column(), 0.0};  // between pieces is empty space
    const double s = t - piece.t0;
    return {column + std::max(0.0, piece.column(s)), std::max(0.0, piece.density(s))};
  }
  /// The column of the whole interval, m.
  double column() const { return pieces_.empty() ? 0.0 : pieces_.back().column + pieces_.back().piece.column(); }
  /// The distance, m, at which the column reaches `target`, which is below that of the whole interval.
  double where(double target) const {
    const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), target,
                                        [](double x, const Before& b) { return x < b.column; });
    const auto& [piece, column] = *(after - 1);
    return piece.t0 + piece.invert(target - column);
  }

 private:
  struct Before {
    DensityPiece piece;
    double column;  // m, from the interval's start to the piece's
  };
  std::vector<Before> pieces_;
};

}  // namespace vpm
