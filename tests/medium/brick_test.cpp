// Bricks of a grid: bounds of their blocks against all values in them; their boxes are disjoint, hold what is occupied,
// and are found by points and by rays in order.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/medium/grid/brick_blocks.h"
#include "vpm/medium/grid/brick_boxes.h"
#include "vpm/medium/grid/density_grid.h"

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

/// A number from 0 to n - 1.
int below(int n, Rng& rng) { return std::min(n - 1, static_cast<int>(rng.uniform() * static_cast<float>(n))); }

/// Boxes of up to 4^3 bricks, some of which overlap, in clusters that lie far apart.
std::vector<IndexBox> clusters(uint64_t seed) {
  Rng rng(seed, rng_stream(RngUse::test, 0), 0);
  std::vector<IndexBox> boxes;
  for (int cluster = 0; cluster < 12; ++cluster) {
    const Vec3i corner(below(1 << 26, rng), below(1 << 12, rng), below(1 << 20, rng));
    for (int i = 0; i < 40; ++i) {
      const Vec3i lo = corner + Vec3i(below(30, rng), below(30, rng), below(30, rng));
      boxes.push_back({lo, lo + Vec3i(below(4, rng), below(4, rng), below(4, rng))});
    }
  }
  return boxes;
}

TEST(BrickBoxes, HoldWhatIsOccupiedOnceAndLittleElse) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<IndexBox> occupied = clusters(seed);
    const BrickBoxes boxes(occupied);
    std::set<size_t> numbers;
    for (const IndexBox& box : occupied)
      for (int z = box.lo.z; z <= box.hi.z; ++z)
        for (int y = box.lo.y; y <= box.hi.y; ++y)
          for (int x = box.lo.x; x <= box.hi.x; ++x) {
            const Vec3i brick(x, y, z);
            const BrickBox* found = boxes.find(brick);
            ASSERT_NE(found, nullptr);
            const size_t number = found->number(brick);
            numbers.insert(number);
            ASSERT_EQ(&boxes.of_number(number), found);
            ASSERT_EQ(found->brick(number), brick);
            ASSERT_LT(number, boxes.bricks());
            int holders = 0;
            for (const BrickBox& other : boxes.all()) holders += other.holds(brick);
            ASSERT_EQ(holders, 1);
          }
    EXPECT_LE(boxes.bricks(), 8 * numbers.size());
    EXPECT_EQ(boxes.find(Vec3i(-1, 0, 0)), nullptr);
  }
}

/// The bricks of n^3 leaves, each of which is a brick and reaches into the next; there is one every `period` bricks.
std::vector<IndexBox> leaves(const Vec3i& corner, int period, int n) {
  std::vector<IndexBox> boxes;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const Vec3i lo = corner + period * Vec3i(x, y, z);
        boxes.push_back({lo, lo + 1});  // the last voxels reach into the next brick
      }
  return boxes;
}

TEST(BrickBoxes, LeavesApartTakeTheirOwnBricks) {
  EXPECT_EQ(BrickBoxes(leaves({}, 4, 12)).bricks(), 8u * 12 * 12 * 12);
}

TEST(BrickBoxes, LeavesThatAdjoinAreOneBox) {
  const BrickBoxes boxes(leaves(Vec3i(7), 1, 20));
  EXPECT_EQ(boxes.all().size(), 1u);
  EXPECT_EQ(boxes.bricks(), 21u * 21 * 21);
}

TEST(BrickBoxes, SolidCloudsApartAreTwoBoxes) {
  std::vector<IndexBox> occupied = leaves({}, 1, 20);
  const std::vector<IndexBox> other = leaves(Vec3i(1200, 0, 0), 1, 20);
  occupied.insert(occupied.end(), other.begin(), other.end());
  const BrickBoxes boxes(occupied);
  EXPECT_EQ(boxes.all().size(), 2u);
  EXPECT_EQ(boxes.bricks(), 2u * 21 * 21 * 21);
}

/// Where a ray enters the box, and leaves it.
std::pair<double, double> crossing(const BrickBox& box, const Vec3d& origin, const Vec3d& direction) {
  double t0 = -1e30, t1 = 1e30;
  for (int a = 0; a < 3; ++a) {
    const double lo = box.lo[a] - origin[a], hi = box.lo[a] + box.count[a] - origin[a];
    if (direction[a] == 0.0) {
      if (lo > 0.0 || hi < 0.0) return {1.0, 0.0};
      continue;
    }
    t0 = std::max(t0, std::min(lo / direction[a], hi / direction[a]));
    t1 = std::min(t1, std::max(lo / direction[a], hi / direction[a]));
  }
  return {t0, t1};
}

TEST(BrickBoxes, AreMetByRaysInOrder) {
  const BrickBoxes boxes(clusters(3));
  ASSERT_GT(boxes.all().size(), 12u);
  Rng rng(5, rng_stream(RngUse::test, 0), 0);
  size_t met = 0;
  for (int i = 0; i < 4000; ++i) {
    // From near a box to near another, every fourth along an axis.
    const auto point = [&] {
      const BrickBox& box = boxes.all()[static_cast<size_t>(below(static_cast<int>(boxes.all().size()), rng))];
      return Vec3d(box.lo) + Vec3d(box.count) * Vec3d(rng.uniform(), rng.uniform(), rng.uniform());
    };
    const Vec3d origin = point();
    Vec3d direction = point() - origin;
    if (i % 4 == 0) direction = Vec3d(i % 8 ? 1.0 : -1.0, 0.0, 0.0);
    const double t0 = i % 3 ? -0.25 : -1e9, t1 = i % 3 ? 0.75 : 1e9;
    std::vector<const BrickBox*> visited;
    boxes.visit(origin, direction, t0, t1, [&](const BrickBox& box) {
      visited.push_back(&box);
      return true;
    });
    double reached = -1e30;
    for (const BrickBox* box : visited) {
      const auto [enter, leave] = crossing(*box, origin, direction);
      if (!(leave > enter)) continue;
      ASSERT_GE(enter, reached - 1e-9 * std::abs(reached));
      reached = leave;
    }
    for (const BrickBox& box : boxes.all()) {
      const auto [enter, leave] = crossing(box, origin, direction);
      if (!(std::min(leave, t1) > std::max(enter, t0))) continue;
      ++met;
      ASSERT_NE(std::find(visited.begin(), visited.end(), &box), visited.end());
    }
  }
  EXPECT_GT(met, 6000u);
}

TEST(BrickBoxes, ARayMayStop) {
  const BrickBoxes boxes({{Vec3i(0), Vec3i(3)}, {Vec3i(100, 0, 0), Vec3i(103, 3, 3)}});
  int visited = 0;
  EXPECT_FALSE(boxes.visit(Vec3d(-1.0, 1.0, 1.0), Vec3d(1.0, 0.0, 0.0), 0.0, 1000.0,
                           [&](const BrickBox&) { return ++visited < 1; }));
  EXPECT_EQ(visited, 1);
}

TEST(BrickBoxes, ManyEvenlySpacedAreAFlatTree) {
  // A tree as deep as its boxes would overflow the stack.
  std::vector<IndexBox> occupied;
  for (int i = 0; i < 60'000; ++i) occupied.push_back({Vec3i(5000 * i, 0, 0), Vec3i(5000 * i + 1, 1, 1)});
  const BrickBoxes boxes(occupied);
  EXPECT_EQ(boxes.all().size(), 60'000u);
  int visited = 0;
  EXPECT_TRUE(boxes.visit(Vec3d(-1.0, 0.5, 0.5), Vec3d(1.0, 0.0, 0.0), 0.0, 3e8,
                          [&](const BrickBox& box) { return box.lo.x == 5000 * visited++; }));
  EXPECT_EQ(visited, 60'000);
}

}  // namespace
}  // namespace vpm
