// Rays through cells: exact, against points along them.
#include "vpm/photon/cell_lattice.h"

#include <gtest/gtest.h>

#include <vector>

#include "vpm/base/rng.h"
#include "vpm/base/warp.h"

namespace vpm {
namespace {

const CellLattice kCells{{{-1.0f, 0.0f, 2.0f}, {2.0f, 1.0f, 4.0f}}, {6, 3, 5}};

TEST(CellLattice, NumbersCellsWithZFirst) {
  EXPECT_EQ(kCells.size(), 90u);
  EXPECT_NEAR(kCells.volume(), 6.0 / 90.0, 1e-12);
  EXPECT_EQ(kCells.cell_at(Vec3(-0.9f, 0.1f, 2.1f)), 0u);
  EXPECT_EQ(kCells.cell_at(Vec3(-0.9f, 0.1f, 2.5f)), 1u);
  EXPECT_EQ(kCells.cell_at(Vec3(-0.9f, 0.5f, 2.1f)), 5u);
  EXPECT_EQ(kCells.cell_at(Vec3(-0.4f, 0.1f, 2.1f)), 15u);
  EXPECT_EQ(kCells.cell_at(Vec3(2.0f, 1.0f, 4.0f)), 89u) << "the last corner is in the last cell";
  EXPECT_FALSE(kCells.cell_at(Vec3(2.1f, 0.5f, 3.0f)));
}

TEST(CellLattice, RaysPassTheCellsOfTheirPoints) {
  for (uint64_t i = 0; i < 2000; ++i) {
    Rng rng(3, rng_stream(RngUse::test, 40), i);
    const Vec3 origin(4.0f * rng.uniform() - 1.5f, 2.0f * rng.uniform() - 0.5f, 3.0f * rng.uniform() + 1.5f);
    Vec3 direction = uniform_sphere(rng.uniform2());
    if (i % 4 == 0) direction = Vec3(i % 3 == 0, i % 3 == 1, i % 3 == 2) * (i % 8 == 0 ? 1.0f : -1.0f);
    const Ray ray{origin, direction};
    double last = -1.0, length = 0.0;
    kCells.visit_along(ray, {0.0f, 3.0f}, [&](size_t cell, double t0, double t1) {
      ASSERT_GE(t0, last);
      ASSERT_GT(t1, t0);
      if (t1 - t0 > 1e-5) {
        ASSERT_EQ(kCells.cell_at(ray.at(static_cast<float>(0.5 * (t0 + t1)))), cell);
      }
      last = t1;
      length += t1 - t0;
    });
    double inside = 0.0;  // of evenly spaced points
    for (int k = 0; k < 3000; ++k)
      if (kCells.box.contains(ray.at(3.0f * (static_cast<float>(k) + 0.5f) / 3000.0f))) inside += 1e-3;
    ASSERT_NEAR(length, inside, 2.1e-3);
  }
}

}  // namespace
}  // namespace vpm
