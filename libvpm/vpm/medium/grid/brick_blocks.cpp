// Bounds of blocks, rounded away from each other.
#include "vpm/medium/grid/brick_blocks.h"

#include <algorithm>

#include "vpm/medium/grid/density_stretch.h"

namespace vpm {
namespace {

DensityBounds extremes(const float* values, const Vec3i& first) {
  constexpr int kValues = DensityStretch::kValues;
  DensityBounds bounds{kInfinity, -kInfinity};
  for (int z = first.z; z <= first.z + BrickBlocks::kCells; ++z)
    for (int y = first.y; y <= first.y + BrickBlocks::kCells; ++y)
      for (int x = first.x; x <= first.x + BrickBlocks::kCells; ++x) {
        const float value = values[(z * kValues + y) * kValues + x];
        bounds = {std::min(bounds.min, value), std::max(bounds.max, value)};
      }
  return bounds;
}

}  // namespace

BrickBlocks::BrickBlocks(const float* values, const DensityBounds& brick) {
  size_t i = 0;
  for (int z = 0; z < kBlocks; ++z)
    for (int y = 0; y < kBlocks; ++y)
      for (int x = 0; x < kBlocks; ++x, ++i) {
        const DensityBounds block = extremes(values, Vec3i(x, y, z) * kCells);
        int up = kSteps, down = kSteps;  // the closest levels that bound, as decode() rounds
        while (up > 0 && !(decode(up, brick).min <= block.min)) --up;
        while (down > 0 && !(decode(down << 4, brick).max >= block.max)) --down;
        levels_[i] = static_cast<uint8_t>(up | down << 4);
      }
}

}  // namespace vpm
