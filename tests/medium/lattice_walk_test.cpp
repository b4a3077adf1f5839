// Walks through lattices against the cells of points on the ray.
#include <gtest/gtest.h>

#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/medium/grid/density_grid.h"

namespace vpm {
namespace {

constexpr Vec3i kLo(-3, 2, 0), kHi(9, 4, 20), kStrides(1, 100, 10000);
constexpr int kMostSteps = 13 + 3 + 21 + 3;  // across all planes, and one of rounding for each axis

struct Line {
  Vec3d origin, direction;
};

template <int spacing>
void expect_cells_along(const Line& line) {
  const auto& [origin, direction] = line;
  const Vec3d lo = Vec3d(kLo * spacing), hi = Vec3d((kHi + 1) * spacing);
  const double size = glm::length(origin) + 1000.0, reach = size / glm::length(direction);
  double t0 = -reach, end = reach;
  clip_to_box(origin, direction, lo, hi, t0, end);
  if (!(end > t0)) return;
  // What rounding can move a point of the ray by.
  const double hair = 2e-15 * size;
  LatticeWalk<spacing> walk(origin, direction, t0, kLo, kHi, kStrides);
  int steps = 0;
  for (double t = t0; t < end; walk.advance(), ++steps) {
    ASSERT_LT(steps, kMostSteps);  // comes to an end
    const double exit = std::min(walk.exit(), end);
    if (!(exit > t)) continue;
    const Vec3d corner = walk.corner();
    const Vec3i cell(glm::round(corner / double{spacing}));
    ASSERT_EQ(Vec3d(cell * spacing), corner);
    ASSERT_TRUE(glm::all(glm::greaterThanEqual(cell, kLo)) && glm::all(glm::lessThanEqual(cell, kHi)));
    const Vec3i steps_from_lo = (cell - kLo) * kStrides;
    ASSERT_EQ(walk.number(), steps_from_lo.x + steps_from_lo.y + steps_from_lo.z);
    for (const double at : {t, 0.5 * (t + exit), exit}) {
      const Vec3d p = origin + at * direction;
      ASSERT_TRUE(glm::all(glm::greaterThanEqual(p, corner - hair)) &&
                  glm::all(glm::lessThanEqual(p, corner + (spacing + hair))));
    }
    t = exit;
  }
}

void expect_cells_along_both_ways(const Line& line) {
  for (const double sign : {1.0, -1.0}) {
    expect_cells_along<1>({line.origin, sign * line.direction});
    expect_cells_along<8>({8.0 * line.origin, sign * line.direction});
  }
}

Vec3d point_in_lattice(Rng& rng) {
  return glm::mix(Vec3d(kLo), Vec3d(kHi + 1), Vec3d(rng.uniform(), rng.uniform(), rng.uniform()));
}

TEST(LatticeWalk, MeetsEveryCellOfRandomRays) {
  for (uint64_t i = 0; i < 20000; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 61), i);
    const Vec3d through = point_in_lattice(rng), direction(uniform_sphere(rng.uniform2()));
    const double back = std::exp2(24.0 * rng.uniform()), scale = std::exp2(40.0 * rng.uniform() - 20.0);
    expect_cells_along_both_ways({through - back * direction, direction});
    expect_cells_along<1>({through, scale * direction});  // tiny voxels and huge ones
  }
}

TEST(LatticeWalk, MeetsEveryCellOfRaysAlongFacesEdgesAndCorners) {
  for (uint64_t i = 0; i < 20000; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 62), i);
    // Components of a few whole numbers, of nearly nothing, and of nothing of either sign; starts on the lattice.
    constexpr double kComponents[] = {0.0, -0.0, 1.0, -1.0, 2.0, -0.5, 1e-38, -1e-38, 1e-310, -1e-310, 1e-8, -1e-15};
    Line line{glm::floor(2.0 * point_in_lattice(rng)) / 2.0, Vec3d(0.0)};
    for (int a = 0; a < 3; ++a) line.direction[a] = kComponents[rng.bits() % 12];
    if (glm::length(line.direction) < 0.5) continue;
    line.origin -= std::floor(1000.0 * rng.uniform()) * line.direction;
    expect_cells_along_both_ways(line);
  }
}

}  // namespace
}  // namespace vpm
