// Points of low discrepancy: Sobol's sequence, scrambled at random.
#pragma once

#include <array>
#include <cstdint>

#include "vpm/base/rng.h"

namespace vpm {

/// The points of one random scrambling of Sobol's sequence in base 2, with the direction numbers of [Joe2008]. Each
/// point by itself is uniform in the cube, and of the first 2^k points each interval of length 2^-k along each axis
/// holds one. Digits are scrambled by a random lower triangular matrix and a random shift [Matousek1998]: the variance
/// of a mean over such points is that of full nested scrambling [Owen2003]. Different scramblings are independent.
class ScrambledSobol {
 public:
  static constexpr int kDimensions = 16;
  /// Coordinates in [0, 1), times 2^32.
  using Point = std::array<uint32_t, kDimensions>;

  explicit ScrambledSobol(Rng rng);

  Point operator[](uint32_t index) const {
    Point point = shift_;
    for (int bit = 0; index != 0; ++bit, index >>= 1)
      if (index & 1u)
        for (int d = 0; d < kDimensions; ++d) point[d] ^= columns_[bit][d];
    return point;
  }

 private:
  std::array<Point, 32> columns_{};  // of the generator matrices: what each bit of an index adds
  Point shift_{};
};

}  // namespace vpm
