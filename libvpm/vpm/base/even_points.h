// Points that lie more evenly than draws do: Sobol's sequence, scrambled at random, and a few points of the unit
// square.
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

/// Hammersley's points, turned at random in one coordinate and scrambled in the other, so that each by itself is
/// uniform in the square: as draws that Rng::uniform2() takes for its two numbers. Other functions of Rng see the first
/// number.
class EvenPoints {
 public:
  /// `number` of them, >= 1.
  EvenPoints(uint32_t number, Rng& rng) : step_((uint64_t{1} << 32) / number), turn_(rng.bits()) {}

  uint64_t operator[](uint32_t i) const {
    const auto along = static_cast<uint32_t>(i * step_ + (turn_ >> 32));
    return (uint64_t{along} << 32) | (reversed(i) ^ static_cast<uint32_t>(turn_));
  }

 private:
  /// The bits in the opposite order: the radical inverse in base 2.
  static uint32_t reversed(uint32_t bits) {
    bits = (bits << 16) | (bits >> 16);
    bits = ((bits & 0x00ff00ffu) << 8) | ((bits & 0xff00ff00u) >> 8);
    bits = ((bits & 0x0f0f0f0fu) << 4) | ((bits & 0xf0f0f0f0u) >> 4);
    bits = ((bits & 0x33333333u) << 2) | ((bits & 0xccccccccu) >> 2);
    return ((bits & 0x55555555u) << 1) | ((bits & 0xaaaaaaaau) >> 1);
  }

  uint64_t step_;
  uint64_t turn_;
};

}  // namespace vpm
