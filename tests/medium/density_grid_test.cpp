// Density grids: look-ups against the definition, walks against look-ups, exact density integrals against quadrature.
#include "vpm/medium/grid/density_grid.h"

#include <gtest/gtest.h>

#include <array>

#include "support/grids.h"
#include "vpm/base/parallel.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"

namespace vpm {
namespace {

GridFrame frame_of(Interpolation interpolation, float background = 0.0f) {
  GridFrame frame;
  frame.index_to_world = awkward_transform();
  frame.lo = Vec3i(-11, 3, -5);
  frame.hi = Vec3i(9, 22, 17);
  frame.interpolation = interpolation;
  frame.background = background;
  return frame;
}

double voxel(const GridFrame& frame, const Vec3i& p) {
  const bool inside = glm::all(glm::greaterThanEqual(p, frame.lo)) && glm::all(glm::lessThanEqual(p, frame.hi));
  return inside ? 2.0 * static_cast<float>(lattice_noise(p.x, p.y, p.z)) : frame.background;
}

/// The definition of the interpolated field at index coordinates.
double defined_density(const GridFrame& frame, const Vec3d& index) {
  if (frame.interpolation == Interpolation::nearest) return voxel(frame, Vec3i(glm::floor(index + 0.5)));
  const Vec3i cell(glm::floor(index));
  const Vec3d f = index - Vec3d(cell);
  double sum = 0.0;
  for (int c = 0; c < 8; ++c) {
    const Vec3i d(c & 1, (c >> 1) & 1, c >> 2);
    const Vec3d w = glm::mix(1.0 - f, f, glm::equal(d, Vec3i(1)));
    sum += w.x * w.y * w.z * voxel(frame, cell + d);
  }
  return sum;
}

std::shared_ptr<const DensityGrid> noise_grid(const GridFrame& frame) {
  return make_grid(frame, [](int x, int y, int z) { return 2.0 * static_cast<float>(lattice_noise(x, y, z)); });
}

class DensityGridTest : public testing::TestWithParam<std::tuple<Interpolation, float>> {};
INSTANTIATE_TEST_SUITE_P(All, DensityGridTest,
                         testing::Combine(testing::Values(Interpolation::trilinear, Interpolation::nearest),
                                          testing::Values(0.0f, 0.7f)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param) == Interpolation::nearest ? "nearest"
                                                                                                : "trilinear") +
                                  (std::get<1>(test.param) > 0.0f ? "_with_background" : "");
                         });

TEST_P(DensityGridTest, LookUpsFollowTheDefinition) {
  const GridFrame frame = frame_of(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const auto grid = noise_grid(frame);
  Rng rng(1, rng_stream(RngUse::test, 0), 0);
  for (int i = 0; i < 20000; ++i) {
    const Vec3d index = Vec3d(-16, -2, -10) + Vec3d(rng.uniform(), rng.uniform(), rng.uniform()) * Vec3d(32, 30, 33);
    const Vec3 world(frame.index_to_world * glm::dvec4(index, 1.0));
    const Vec3d exact_index(glm::inverse(frame.index_to_world) * glm::dvec4(Vec3d(world), 1.0));
    if (frame.interpolation == Interpolation::nearest) {
      const Vec3d off = glm::abs(glm::fract(exact_index) - 0.5);
      if (std::min(off.x, std::min(off.y, off.z)) < 1e-4) continue;
    }
    ASSERT_NEAR(grid->density(world), defined_density(frame, exact_index), 2e-6);
  }
}

/// A random ray at the grid of frame_of(); every other one may miss it.
Ray ray_at_grid(const GridFrame& frame, int number, Rng& rng) {
  const Vec3d spread = Vec3d(20.0, 15.0, 16.0) * (number % 2 ? 3.0 : 1.0);
  const Vec3d middle = Vec3d(0.0, 12.5, 8.0) + spread * (Vec3d(rng.uniform(), rng.uniform(), rng.uniform()) - 0.5);
  const Vec3 target(frame.index_to_world * glm::dvec4(middle, 1.0));
  const Vec3 origin = target - 3.0f * uniform_sphere(rng.uniform2());
  return {origin, glm::normalize(target - origin)};
}

TEST_P(DensityGridTest, LookUpsAtOnceAreThoseOneByOne) {
  const auto grid = noise_grid(frame_of(std::get<0>(GetParam()), std::get<1>(GetParam())));
  const Box bounds = grid->bounds();
  for (uint64_t i = 0; i < 200; ++i) {
    Rng rng(7, rng_stream(RngUse::test, 0), i);
    const Vec3 origin = bounds.lo + bounds.extent() * Vec3(rng.uniform(), rng.uniform(), rng.uniform());
    const auto ray = grid->lattice_ray({origin, uniform_sphere(rng.uniform2())});
    const double begin = -rng.uniform() * bounds.diagonal(), step = rng.uniform() * bounds.diagonal() / 8.0;
    std::array<float, DensityGrid::kAtOnce> at_once;
    at_once.fill(-1.0f);
    const size_t count = i % (DensityGrid::kAtOnce + 1);
    grid->densities(ray, begin, step, {at_once.data(), count});
    for (size_t k = 0; k < count; ++k)
      EXPECT_EQ(at_once[k], grid->density(ray, begin + static_cast<double>(k) * step)) << "ray " << i << ", " << k;
    for (size_t k = count; k < at_once.size(); ++k) EXPECT_EQ(at_once[k], -1.0f) << "ray " << i << ", " << k;
  }
}

TEST_P(DensityGridTest, WalksMeetEveryPieceOfTheField) {
  const GridFrame frame = frame_of(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const auto grid = noise_grid(frame);
  const Mat4d to_index = glm::inverse(frame.index_to_world);
  Rng rng(1, rng_stream(RngUse::test, 1), 0);
  for (int i = 0; i < 500; ++i) {
    const Ray aimed = ray_at_grid(frame, i, rng);
    const Interval interval{0.2f, 5.5f};
    double end = interval.t0, total = 0.0;
    grid->visit_pieces(aimed, interval, [&](const DensityPiece& piece) {
      EXPECT_GE(piece.t0, end - 1e-12);
      EXPECT_GT(piece.t1, piece.t0);
      EXPECT_TRUE(frame.background == 0.0f || std::abs(piece.t0 - end) < 1e-9);
      end = piece.t1;
      total += piece.integral();
      const double s = rng.uniform() * piece.length();
      const Vec3d p = Vec3d(aimed.origin) + (piece.t0 + s) * Vec3d(aimed.direction);
      EXPECT_NEAR(piece.density(s), defined_density(frame, Vec3d(to_index * glm::dvec4(p, 1.0))), 2e-5);
      return true;
    });
    EXPECT_LE(end, interval.t1 + 1e-9);
    EXPECT_TRUE(frame.background == 0.0f || std::abs(end - interval.t1) < 1e-9);
    if (i >= 20) continue;  // quadrature is slow
    double sum = 0.0;
    constexpr int kSteps = 20000;
    for (int k = 0; k < kSteps; ++k) {
      const double t = interval.t0 + (k + 0.5) / kSteps * interval.length();
      const Vec3d p = Vec3d(aimed.origin) + t * Vec3d(aimed.direction);
      sum += defined_density(frame, Vec3d(to_index * glm::dvec4(p, 1.0)));
    }
    const double tolerance = frame.interpolation == Interpolation::trilinear ? 2e-5 : 5e-3;
    ASSERT_NEAR(total, sum * interval.length() / kSteps, tolerance);
  }
}

/// The extremes over the 9^3 voxels of the brick around a lattice point, one by one.
std::pair<double, double> brick_extremes(const GridFrame& frame, const Vec3d& lattice) {
  const Vec3i lo = Vec3i(glm::floor(lattice / 8.0)) * 8;
  std::pair extremes(voxel(frame, lo), voxel(frame, lo));
  for (int z = 0; z <= 8; ++z)
    for (int y = 0; y <= 8; ++y)
      for (int x = 0; x <= 8; ++x) {
        const double value = voxel(frame, lo + Vec3i(x, y, z));
        extremes = {std::min(extremes.first, value), std::max(extremes.second, value)};
      }
  return extremes;
}

TEST_P(DensityGridTest, MajorantsAreTheExtremesOfTheBricksOnTheWay) {
  const GridFrame frame = frame_of(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const auto grid = noise_grid(frame);
  const Mat4d to_index = glm::inverse(frame.index_to_world);
  const double shift = frame.interpolation == Interpolation::nearest ? 0.5 : 0.0;
  Rng rng(1, rng_stream(RngUse::test, 2), 0);
  for (int i = 0; i < 300; ++i) {
    const Ray ray = ray_at_grid(frame, i, rng);
    const Interval interval{0.2f, 5.5f};
    const auto index_at = [&](double t) {
      return Vec3d(to_index * glm::dvec4(Vec3d(ray.origin) + t * Vec3d(ray.direction), 1.0));
    };
    const auto between = [&](double a, double b) { return a + rng.uniform_double() * (b - a); };
    const auto expect_empty = [&](double a, double b) {
      if (!(b > a + 1e-9)) return;
      for (int k = 0; k < 3; ++k) EXPECT_EQ(defined_density(frame, index_at(between(a, b))), 0.0);
    };
    double end = interval.t0;
    grid->visit_majorants(ray, interval, [&](const DensityStretch& stretch) {
      EXPECT_GE(stretch.t0, end - 1e-12);
      EXPECT_GT(stretch.t1, stretch.t0);
      expect_empty(end, stretch.t0);
      end = stretch.t1;
      const auto [min, max] = brick_extremes(frame, index_at(0.5 * (stretch.t0 + stretch.t1)) + shift);
      EXPECT_EQ(stretch.min, static_cast<float>(min));
      EXPECT_EQ(stretch.max, static_cast<float>(max));
      for (int k = 0; k < 10; ++k) {
        const double t = between(stretch.t0, stretch.t1);
        EXPECT_NEAR(stretch.density(t), defined_density(frame, index_at(t)), 1e-6);
        EXPECT_TRUE(stretch.density(t) >= stretch.min && stretch.density(t) <= stretch.max);
      }
      return true;
    });
    EXPECT_LE(end, interval.t1 + 1e-9);
    expect_empty(end, interval.t1);
  }
}

TEST(DensityGrid, MajorantsEndWhereAskedTo) {
  const auto grid = noise_grid(frame_of(Interpolation::trilinear, 0.7f));
  Rng rng(1, rng_stream(RngUse::test, 3), 0);
  const Ray ray = ray_at_grid(grid->frame(), 0, rng);
  for (int wanted = 1; wanted <= 4; ++wanted) {
    int visited = 0;
    grid->visit_majorants(ray, {}, [&](const DensityStretch&) { return ++visited < wanted; });
    EXPECT_EQ(visited, wanted);
  }
}

TEST(DensityGrid, RaysAlongFacesAndEdgesOfCellsSeeTheField) {
  GridFrame frame;
  frame.lo = Vec3i(0);
  frame.hi = Vec3i(20);
  const auto grid = make_grid(frame, [](int x, int y, int z) { return 1.0 + 0.1 * x + 0.01 * y + 0.001 * z; });
  for (const Vec3& direction :
       {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
    for (const Vec3& through : {Vec3(8.0f, 8.0f, 8.0f), Vec3(8.0f, 3.0f, 16.0f), Vec3(5.5f, 16.0f, 8.0f)}) {
      const Ray ray{through - 100.0f * direction, direction};
      double total = 0.0;
      grid->visit_pieces(ray, {}, [&](const DensityPiece& piece) {
        total += piece.integral();
        return true;
      });
      // Linear inside the lattice, fading to 0 over one voxel at both ends.
      const Vec3 along = glm::abs(direction);
      const double middle = 1.0 + glm::dot(glm::mix(through, Vec3(10.0f), along), Vec3(0.1f, 0.01f, 0.001f));
      EXPECT_NEAR(total, 21.0 * middle, 2e-5) << direction.x << direction.y << direction.z;
    }
  }
}

TEST(DensityGrid, KnowsItsExtremesAndMean) {
  GridFrame frame;
  frame.lo = Vec3i(-3);
  frame.hi = Vec3i(30, 5, 9);
  frame.index_to_world = glm::scale(Mat4d(1.0), Vec3d(0.5, 0.25, 2.0));
  double sum = 0.0;
  const auto field = [](int x, int y, int z) { return x == 4 && y == 1 && z == 2 ? 9.0 : lattice_noise(x, y, z); };
  const auto grid = make_grid(frame, field);
  for (int z = -3; z <= 9; ++z)
    for (int y = -3; y <= 5; ++y)
      for (int x = -3; x <= 30; ++x) sum += field(x, y, z);
  EXPECT_EQ(grid->max_density(), 9.0f);
  EXPECT_NEAR(grid->mean_density(), sum / (35.0 * 10.0 * 14.0), 1e-6);
  EXPECT_FLOAT_EQ(grid->voxel_size(), 0.25f);
  frame.background = 0.7f;  // fills what the support has beyond the voxels
  const auto in_haze = make_grid(frame, field);
  const double beyond = 35.0 * 10.0 * 14.0 - 34.0 * 9.0 * 13.0;
  EXPECT_NEAR(in_haze->mean_density(), (sum + 0.7f * beyond) / (35.0 * 10.0 * 14.0), 1e-6);
  EXPECT_EQ(make_grid(frame, [](int, int, int) { return 0.7; })->max_density(), 0.7f);
}

// A yes is true of every point of the box; a no may be wrong near bricks that hold a zero, but not far from them.
// Grids of all kinds are filled wave by wave, and most of those in these tests by the first.
TEST(DensityGrid, OfManyBricksHoldsEveryVoxelOnAnyNumberOfThreads) {
  GridFrame frame;
  frame.hi = Vec3i(136, 130, 141);
  frame.interpolation = Interpolation::nearest;
  const auto value = [](int x, int y, int z) { return z < 9 ? 0.25f : static_cast<float>(lattice_noise(x, y, z)); };
  double sum = 0.0;
  for (int z = 0; z <= frame.hi.z; ++z)
    for (int y = 0; y <= frame.hi.y; ++y)
      for (int x = 0; x <= frame.hi.x; ++x) sum += value(x, y, z);
  for (const int threads : {1, 3}) {
    set_threads(threads);
    const auto grid = make_grid(frame, value);
    set_threads(0);
    EXPECT_NEAR(grid->mean_density(), sum / (137.0 * 131.0 * 142.0), 1e-12);
    for (int z = 0; z <= frame.hi.z; ++z)
      for (int y = 0; y <= frame.hi.y; ++y)
        for (int x = 0; x <= frame.hi.x; ++x) ASSERT_EQ(grid->density(Vec3(x, y, z)), value(x, y, z));
  }
}

TEST(DensityGrid, KnowsWhereItIsPositive) {
  for (const float background : {0.0f, 0.5f})
    for (const Interpolation interpolation : {Interpolation::trilinear, Interpolation::nearest}) {
      const GridFrame frame = frame_of(interpolation, background);
      const auto is_hole = [](int x, int y, int z) { return x == 2 && y == 9 && z == 4; };
      const auto grid = make_grid(frame, [&](int x, int y, int z) { return is_hole(x, y, z) ? 0.0 : 1.0; });
      const auto box_at = [&](const Vec3d& index, float half) {
        const Vec3 center(frame.index_to_world * glm::dvec4(index, 1.0));
        return Box{center - half, center + half};
      };
      int yes = 0;
      for (uint64_t i = 0; i < 3000; ++i) {
        Rng rng(1, rng_stream(RngUse::test, 50), i);
        const Vec3d index =
            Vec3d(-16, -2, -10) + Vec3d(rng.uniform(), rng.uniform(), rng.uniform()) * Vec3d(32, 30, 33);
        const Box box = box_at(index, 0.2f * rng.uniform());
        if (!grid->is_positive(box)) continue;
        ++yes;
        for (int k = 0; k < 30; ++k) {
          const Vec3 u(rng.uniform(), rng.uniform(), rng.uniform());
          ASSERT_GT(grid->density(glm::mix(box.lo, box.hi, u)), 0.0f);
        }
      }
      EXPECT_GT(yes, 20);
      EXPECT_FALSE(grid->is_positive(box_at({2, 9, 4}, 1e-4f)));
      EXPECT_TRUE(grid->is_positive(box_at({-4, 12, 12}, 1e-4f)));
      EXPECT_EQ(grid->is_positive(box_at({-40, 18, 12}, 1e-4f)), background > 0.0f);
    }
}

TEST(DensityGrid, EmptySpaceCostsNoLookUps) {
  GridFrame frame;
  frame.lo = Vec3i(0);
  frame.hi = Vec3i(511);
  const auto grid = make_grid(frame, [](int x, int, int) { return x == 500 ? 1.0 : 0.0; });
  int pieces = 0;
  const uint32_t read =
      grid->visit_pieces({Vec3(-5, 100, 100), Vec3(1, 0, 0)}, {}, [&](const DensityPiece&) { return ++pieces; });
  EXPECT_LE(read, 9u);
  EXPECT_LT(grid->memory_bytes(), 24u << 20);
}

TEST(DensityGrid, EqualBricksAreKeptOnce) {
  GridFrame frame;
  frame.lo = Vec3i(0);
  frame.hi = Vec3i(127);
  const auto field = [](int x, int y, int z) { return 1.0 + (x / 32 + y / 32 + z / 32) % 2; };
  const auto grid = make_grid(frame, field);
  EXPECT_LT(grid->memory_bytes(), 1u << 20);  // 17^3 bricks, 7 kinds of borders
  for (int i = 0; i < 128; ++i)
    EXPECT_EQ(grid->density(Vec3(i, (7 * i) % 128, (31 * i) % 128)), field(i, (7 * i) % 128, (31 * i) % 128));
}

TEST(DensityPiece, InvertsItsDensityIntegral) {
  Rng rng(1, rng_stream(RngUse::test, 2), 0);
  for (int i = 0; i < 20000; ++i) {
    // Random cubics made non-negative by squaring a linear factor: roots lie on and inside the piece.
    const double a = 2.0 * rng.uniform_double() - 0.5, b = rng.uniform_double(), c = 3.0 * rng.uniform_double();
    DensityPiece piece{1.0, 1.0 + 0.5 + rng.uniform_double(), 0, 0, 0, 0};
    piece.c0 = b * a * a;
    piece.c1 = c * a * a - 2.0 * a * b;
    piece.c2 = b - 2.0 * a * c;
    piece.c3 = c;
    const double target = rng.uniform_double() * piece.integral();
    const double s = piece.invert(target);
    ASSERT_GE(s, 0.0);
    ASSERT_LE(s, piece.length());
    ASSERT_NEAR(piece.integral(s), target, 1e-11 * (1.0 + piece.integral()));
  }
}

}  // namespace
}  // namespace vpm
