// A few points that lie evenly in the unit square.
#pragma once

#include <cstdint>

#include "vpm/base/rng.h"

namespace vpm {

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
