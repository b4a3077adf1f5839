// Bounds of the density in parts of a brick: the finest level of a grid's bounds.
#pragma once

#include <array>
#include <cstdint>

#include "vpm/base/vec.h"

namespace vpm {

struct DensityBounds {
  float min, max;
};

/// Bounds of the density in blocks of 2^3 cells. They are stored in steps of a fifteenth of the range from the brick's
/// least density to its largest. They take one cache line, whereas the brick's values take 46.
class alignas(64) BrickBlocks {
 public:
  static constexpr int kCells = 2;   // along a block's edge
  static constexpr int kBlocks = 4;  // along a brick's edge: of kCells * kBlocks cells

  BrickBlocks() = default;
  /// From the brick's 9^3 values and their bounds, min < max.
  BrickBlocks(const float* values, const DensityBounds& brick);

  /// The bounds in the block that holds a cell of the brick; never wider than the brick's own.
  DensityBounds bounds(const Vec3i& cell, const DensityBounds& brick) const {
    const Vec3i block = cell / kCells;
    return decode(levels_[(block.z * kBlocks + block.y) * kBlocks + block.x], brick);
  }

 private:
  static constexpr int kSteps = 15;

  /// The lower four bits count steps upwards from the brick's least density, the upper ones downwards from its largest.
  static DensityBounds decode(int levels, const DensityBounds& brick) {
    const float step = (brick.max - brick.min) / kSteps;
    return {brick.min + static_cast<float>(levels & 15) * step, brick.max - static_cast<float>(levels >> 4) * step};
  }

  std::array<uint8_t, kBlocks * kBlocks * kBlocks> levels_{};
};

}  // namespace vpm
