// The numbers that a value may have, and how that is said.
#pragma once

#include <limits>
#include <string>

namespace vpm {

/// Numbers between two ends, each of which belongs to them unless it is open.
struct Range {
  double lo, hi;
  bool lo_open, hi_open;
};
inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();
inline constexpr Range kAny{-kNoLimit, kNoLimit, true, true};
inline constexpr Range kPositive{0.0, kNoLimit, true, true};
inline constexpr Range kNotNegative{0.0, kNoLimit, false, true};
inline constexpr Range kFraction{0.0, 1.0, false, false};

/// Does the number lie in the range, as it is and in single precision? The ends of a closed range belong to it in
/// either. NaN lies in none.
bool contains(const Range& range, double value);
/// Does a number that is known in single precision alone?
bool contains(const Range& range, float value);

/// "finite", "> 0", "in [0, 1)".
std::string text_of(const Range& range);
/// Of nine digits at the most.
std::string text_of(double value);

}  // namespace vpm
