// Bounds of blocks against all values in them.
#include "vpm/medium/brick_blocks.h"

#include <gtest/gtest.h>
#include <algorithm>

#include "vpm/base/rng.h"
#include "vpm/medium/density_grid.h"

namespace vpm {
namespace {

constexpr int kValues = DensityStretch::kValues;

/// The extremes over the 3^3 values of the block that holds a cell.
DensityBounds extremes(const std::vector<float>& values, const Vec3i& cell) {
  const Vec3i lo = cell - cell % 2;
  DensityBounds bounds{kInfinity, -kInfinity};
  for (int z = lo.z; z <= lo.z + 2; ++z)
    for (int y = lo.y; y <= lo.y + 2; ++y)
      for (int x = lo.x; x <= lo.x + 2; ++x) {
        const float value = values[(z * kValues + y) * kValues + x];
        bounds = {std::min(bounds.min, value), std::max(bounds.max, value)};
      }
  return bounds;
}

TEST(BrickBlocks, BoundAllValuesAndFewOthers) {
  for (uint64_t i = 0; i < 200; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 60), i);
    // From faint to dense, from a hair of variation to spikes among zeros.
    const double scale = std::exp2(200.0 * rng.uniform() - 100.0), base = i % 3 == 0 ? 1.0 : 0.0;
    const double spread = i % 3 == 0 ? std::exp2(-23.0 * rng.uniform()) : 1.0, power = i % 2 ? 1.0 : 30.0;
    std::vector<float> values(DensityGrid::kBrickValues);
    for (float& value : values)
      value = static_cast<float>(scale * (base + spread * std::pow(rng.uniform_double(), power)));
    const auto [min, max] = std::minmax_element(values.begin(), values.end());
    const DensityBounds brick{*min, *max};
    const BrickBlocks blocks(values.data(), brick);
    for (int c = 0; c < 512; ++c) {
      const Vec3i cell(c & 7, (c >> 3) & 7, c >> 6);
      const DensityBounds bounds = blocks.bounds(cell, brick), exact = extremes(values, cell);
      const float step = 1.001f * (brick.max - brick.min) / 15.0f + 2e-7f * brick.max;
      ASSERT_TRUE(bounds.min <= exact.min && bounds.max >= exact.max);
      ASSERT_TRUE(bounds.min >= brick.min && bounds.max <= brick.max);
      ASSERT_TRUE(exact.min - bounds.min <= step && bounds.max - exact.max <= step);
    }
  }
}

}  // namespace
}  // namespace vpm
