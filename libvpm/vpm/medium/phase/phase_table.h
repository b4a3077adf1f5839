// A phase function by a table of angles and values, as of particles that were measured or computed.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace vpm {

/// Values of any normalisation become a density over the sphere. They are linear in the angle between those that are
/// given; and are kept at kCells + 1 even steps of s = sin(angle / 2), linear in between: steps of 0.03 degrees
/// forward, where tables have their peaks.
class PhaseTable {
 public:
  static constexpr int kCells = 4096;

  /// Angles between the directions of travel before and after, degrees, rising from 0 to 180; values >= 0, which are
  /// the mean of so many columns. Throws InputError for others, and where all values are 0.
  PhaseTable(std::span<const double> degrees, std::span<const double> values, int columns = 1);

  /// 1/sr, at s in [0, 1].
  float value(float s) const {
    const float x = std::min(s, 1.0f) * kCells;
    const auto cell = static_cast<size_t>(std::min(x, kCells - 1.0f));
    const float part = x - static_cast<float>(cell);
    return values_[cell] + part * (values_[cell + 1] - values_[cell]);
  }
  /// 1 - cos of the angle within which the share `u` in [0, 1) is scattered.
  double away_within(double u) const;
  double mean_cosine() const { return mean_cosine_; }
  double mean_square_cosine() const { return mean_square_cosine_; }
  /// The integral over the sphere of the values that were given.
  double total() const { return total_; }
  int columns() const { return columns_; }

 private:
  double within(size_t cell, double x) const;

  std::vector<float> values_;
  std::vector<double> cumulative_;  // up to the beginning of each cell, and 1
  int columns_ = 1;
  double mean_cosine_ = 0.0, mean_square_cosine_ = 0.0, total_ = 0.0;
};

}  // namespace vpm
