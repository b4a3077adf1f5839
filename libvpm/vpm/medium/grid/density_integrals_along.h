// The density integral and the density at many places of one ray, queried in any order after one walk along the ray.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "vpm/medium/medium.h"

namespace vpm {

/// The density integral of a medium along a segment of a ray, from its start to any place. Keeps its buffers from ray
/// to ray; each thread needs its own object.
class DensityIntegralsAlong {
 public:
  /// Walks the medium along the interval, which may be infinite; `medium` null: vacuum. Returns the number of look-ups.
  uint32_t walk(const Medium* medium, const Ray& ray, const Interval& interval) {
    pieces_.clear();
    double before = 0.0;
    uint32_t lookups = 0;
    if (medium)
      lookups = medium->visit_pieces(ray, interval, [&](const DensityPiece& piece) {
        pieces_.push_back({piece, before});
        before += piece.integral();
        return true;
      });
    make_slots();
    return lookups;
  }

  struct Place {
    double integral;  // m, from the interval's start to this place
    double density;   // at this place
  };
  /// The values at the distance `t` (m, finite) within the interval.
  Place at(double t) const {
    assert(std::isfinite(t));
    if (pieces_.empty() || t < starts_.front()) return {0.0, 0.0};
    const double slot = std::min((t - starts_.front()) * slots_per_metre_, static_cast<double>(first_.size() - 1));
    size_t i = first_[static_cast<size_t>(slot)];
    // The piece is seldom more than two steps on. These are taken without branches, because they cannot be predicted.
    for (int step = 0; step < 2; ++step) i += starts_[i + 1] <= t ? 1 : 0;
    while (starts_[i + 1] <= t) ++i;
    const auto& [piece, integral] = pieces_[i];
    if (t > piece.t1) return {integral + piece.integral(), 0.0};  // between pieces the density is zero
    const double s = t - piece.t0;
    return {integral + std::max(0.0, piece.integral(s)), std::max(0.0, piece.density(s))};
  }
  /// The density integral of the whole interval, m.
  double integral() const { return pieces_.empty() ? 0.0 : pieces_.back().integral + pieces_.back().piece.integral(); }
  /// The distance, m, at which the density integral reaches `target`, which is below that of the whole interval.
  double where(double target) const {
    const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), target,
                                        [](double x, const Before& b) { return x < b.integral; });
    const auto& [piece, integral] = *(after - 1);
    return piece.t0 + piece.invert(target - integral);
  }

 private:
  struct Before {
    DensityPiece piece;
    double integral;  // m, from the interval's start to the piece's
  };

  /// Divides the walk into as many slots of equal length as there are pieces. A place is found by its slot and a few
  /// steps from there.
  void make_slots() {
    const size_t count = pieces_.size();
    starts_.clear();
    for (const Before& before : pieces_) starts_.push_back(before.piece.t0);
    starts_.push_back(std::numeric_limits<double>::quiet_NaN());  // no place compares beyond it
    first_.resize(count);
    if (count == 0) return;
    const double length = starts_[count - 1] - starts_[0];
    slots_per_metre_ = length > 0.0 ? static_cast<double>(count) / length : 0.0;
    for (size_t slot = 0, i = 0; slot < count; ++slot) {
      const double from = starts_[0] + static_cast<double>(slot) * length / static_cast<double>(count);
      while (starts_[i + 1] <= from) ++i;
      first_[slot] = static_cast<uint32_t>(i);
    }
  }

  std::vector<Before> pieces_;
  std::vector<double> starts_;   // where the pieces begin, m, and a last entry that ends every search
  std::vector<uint32_t> first_;  // for each slot: the last piece that begins no later than the slot
  double slots_per_metre_ = 0.0;
};

}  // namespace vpm
