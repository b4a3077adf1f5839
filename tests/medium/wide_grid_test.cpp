// Grids far wider than what they hold: each cloud of one is what it is by itself.
#include <gtest/gtest.h>

#include "support/grids.h"
#include "vpm/base/error.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/medium/grid/density_grid.h"

namespace vpm {
namespace {

constexpr int kSize = 40;              // voxels along a cloud
constexpr int kApart = 1'000'000'000;  // from one to the next

float value(const Vec3i& p) { return 0.1f + static_cast<float>(lattice_noise(p.x, p.y, p.z)); }

/// Voxels p with 0 <= p < kSize, `at` voxels along x, y and z.
IndexBox cloud(const Vec3i& at) { return {at, at + kSize - 1}; }

/// The frame of these clouds; voxels are a micrometre wide, so that they lie 1 km apart.
GridFrame frame_of(const std::vector<IndexBox>& clouds, Interpolation interpolation, float background) {
  GridFrame frame = centered_frame(0, 1e-6, interpolation);
  frame.lo = clouds.front().lo;
  frame.hi = clouds.front().hi;
  for (const IndexBox& box : clouds) {
    frame.lo = glm::min(frame.lo, box.lo);
    frame.hi = glm::max(frame.hi, box.hi);
  }
  frame.background = background;
  return frame;
}

/// Clouds alike, which the grid holds.
std::shared_ptr<const DensityGrid> grid_of(const std::vector<IndexBox>& clouds, Interpolation interpolation,
                                           float background) {
  const auto fill = [&](const Vec3i& origin, float* values) {
    for (int z = 0, n = 0; z < DensityGrid::kValues; ++z)
      for (int y = 0; y < DensityGrid::kValues; ++y)
        for (int x = 0; x < DensityGrid::kValues; ++x, ++n) {
          const Vec3i p = origin + Vec3i(x, y, z);
          values[n] = background;
          for (const IndexBox& box : clouds)
            if (glm::all(glm::greaterThanEqual(p, box.lo)) && glm::all(glm::lessThanEqual(p, box.hi)))
              values[n] = value(p - box.lo);
        }
    return DensityGrid::Filled::all;
  };
  return std::make_shared<const DensityGrid>(frame_of(clouds, interpolation, background), fill, clouds);
}

struct WideWalk {
  double integral = 0.0, length = 0.0;
  uint32_t read = 0;
};

WideWalk walk_wide(const DensityGrid& grid, const Ray& ray, const Interval& interval) {
  WideWalk all;
  double reached = interval.t0;
  all.read = grid.visit_pieces(ray, interval, [&](const DensityPiece& piece) {
    EXPECT_GE(piece.t0, reached - 1e-9);
    reached = piece.t1;
    all.integral += piece.integral(piece.t1 - piece.t0);
    all.length += piece.t1 - piece.t0;
    return true;
  });
  return all;
}

class WideGrid : public testing::TestWithParam<std::tuple<Interpolation, float>> {
 protected:
  // The second begins where a brick does, as the first does.
  const std::vector<IndexBox> clouds_{cloud(Vec3i(0)), cloud(Vec3i(kApart, kApart - 8, 0)),
                                      cloud(Vec3i(0, kApart, kApart))};
  const Interpolation interpolation_ = std::get<0>(GetParam());
  const float background_ = std::get<1>(GetParam());
  std::shared_ptr<const DensityGrid> wide_ = grid_of(clouds_, interpolation_, background_);
  std::shared_ptr<const DensityGrid> alone_ = grid_of({clouds_[0]}, interpolation_, background_);
};
INSTANTIATE_TEST_SUITE_P(All, WideGrid,
                         testing::Combine(testing::Values(Interpolation::trilinear, Interpolation::nearest),
                                          testing::Values(0.0f, 0.3f)));

TEST_P(WideGrid, TakesAsMuchMemoryAsItsClouds) {
  EXPECT_LT(wide_->memory_bytes(), 3 * alone_->memory_bytes());
  EXPECT_EQ(wide_->max_density(), alone_->max_density());
}

TEST_P(WideGrid, HasTheDensitiesOfACloudByItself) {
  Rng rng(1, rng_stream(RngUse::test, 0), 0);
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 p = 1e-6f * (Vec3(-8.0f) + (kSize + 16.0f) * Vec3(rng.uniform(), rng.uniform(), rng.uniform()));
    ASSERT_EQ(wide_->density(p), alone_->density(p));
  }
  EXPECT_EQ(wide_->density(Vec3(500.0f, 20.0f, 3.0f)), background_);
}

TEST_P(WideGrid, MayHoldOneCloudInACornerOfItsFrame) {
  GridFrame frame = frame_of(clouds_, interpolation_, background_);
  const DensityGrid one(frame,
                        [&](const Vec3i&, float* values) {
                          values[0] = 1.0f;
                          return DensityGrid::Filled::one;
                        },
                        {cloud(Vec3i(8000, 16000, 24000))});
  const Vec3 middle(8020e-6f, 16020e-6f, 24020e-6f);
  EXPECT_EQ(one.density(middle), 1.0f);
  EXPECT_EQ(one.density(Vec3(20e-6f)), background_);
  EXPECT_EQ(one.density(Vec3(900.0f)), background_);
  const WideWalk along = walk_wide(one, {middle - Vec3(1e-3f, 0.0f, 0.0f), Vec3(1.0f, 0.0f, 0.0f)}, {0.0f, 500.0f});
  EXPECT_NEAR(along.integral - background_ * along.length, 48e-6 * (1.0 - background_), 9e-6);
}

TEST_P(WideGrid, IsWalkedThroughLikeACloudByItself) {
  Rng rng(2, rng_stream(RngUse::test, 0), 0);
  for (int i = 0; i < 500; ++i) {
    const auto point = [&] { return 1e-6f * kSize * Vec3(rng.uniform(), rng.uniform(), rng.uniform()); };
    const Vec3 target = point();
    const Vec3 origin = target - 1e-4f * uniform_sphere(rng.uniform2());
    const Ray aimed{origin, glm::normalize(target - origin)};
    const Interval interval{0.0f, 2e-4f};
    const WideWalk a = walk_wide(*wide_, aimed, interval), b = walk_wide(*alone_, aimed, interval);
    ASSERT_NEAR(a.integral, b.integral, 1e-12);
    ASSERT_NEAR(a.length, b.length, 1e-12);
    double majorants[2] = {0.0, 0.0};
    for (const int which : {0, 1})
      (which ? alone_ : wide_)->visit_majorants(aimed, interval, [&](const DensityStretch& stretch) {
        majorants[which] += stretch.max * (stretch.t1 - stretch.t0);
        return true;
      });
    ASSERT_NEAR(majorants[0], majorants[1], 1e-12);
  }
}

TEST_P(WideGrid, IsCrossedInAFewSteps) {
  // Through the first cloud and the third, 1.4 km away.
  const Vec3 middle(Vec3d(1e-6 * 0.5 * kSize));
  const Ray ray{middle - 1e-3f * glm::normalize(Vec3(0, 1, 1)), glm::normalize(Vec3(0, 1, 1))};
  const WideWalk all = walk_wide(*wide_, ray, {0.0f, 2000.0f});
  EXPECT_LT(all.read, 500u);
  const WideWalk one = walk_wide(*alone_, ray, {0.0f, 1.0f});
  EXPECT_GT(one.integral - background_ * one.length, 1e-5);
  EXPECT_NEAR(all.integral - background_ * all.length, 2.0 * (one.integral - background_ * one.length), 1e-9);
  EXPECT_NEAR(all.length, background_ > 0.0f ? 2000.0 : all.length, 1e-3);
}

TEST_P(WideGrid, KnowsItsMeanAndWhereItIsPositive) {
  const double support = 1e9 + kSize + (interpolation_ == Interpolation::nearest ? 0.0 : 1.0);
  double sum = 0.0;
  for (int z = 0; z < kSize; ++z)
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) sum += value(Vec3i(x, y, z));
  const double expected =
      background_ + 3.0 * (sum - background_ * kSize * kSize * kSize) / (support * support * support);
  EXPECT_NEAR(wide_->mean_density(), expected, 1e-6 * expected);
  EXPECT_EQ(alone_->mean_of_stored(), alone_->mean_density());
  EXPECT_EQ(alone_->extent(), double{alone_->bounds().diagonal()});
  EXPECT_LE(wide_->mean_of_stored(), alone_->mean_of_stored());  // its bricks reach beyond the support
  EXPECT_GT(wide_->mean_of_stored(), 0.5 * alone_->mean_of_stored());
  const double clouds = std::cbrt(3.0 * 48 * 48 * 48) * std::sqrt(3.0) * 1e-6;  // of six bricks along each axis
  EXPECT_NEAR(wide_->extent(), clouds, 1e-6 * clouds);
  const auto positive = [&](const Vec3& from, float side) { return wide_->is_positive({from, from + side}); };
  EXPECT_TRUE(positive(Vec3(9e-6f), 12e-6f));
  EXPECT_EQ(positive(Vec3(30e-6f), 100e-6f), background_ > 0.0f);
  EXPECT_EQ(positive(Vec3(400.0f), 1.0f), background_ > 0.0f);
  EXPECT_EQ(positive(Vec3(1e9f), 1.0f), background_ > 0.0f);  // 1e15 voxels away
}

TEST(WideGrids, ThatHoldTooMuchAreRefused) {
  const IndexBox all{Vec3i(0), Vec3i(100'000)};
  GridFrame frame = centered_frame(0, 1.0);
  frame.hi = all.hi;
  bool asked = false;
  const auto fill = [&](const Vec3i&, float*) {
    asked = true;
    return DensityGrid::Filled::one;
  };
  EXPECT_THROW(DensityGrid(frame, fill, {all}), InputError);
  frame.lo = Vec3i(-(1 << 30), 0, 0);
  frame.hi = Vec3i((1 << 30), 0, 0);
  EXPECT_THROW(DensityGrid(frame, fill, {{frame.lo, frame.lo}, {frame.hi, frame.hi}}), InputError);
  EXPECT_FALSE(asked);
}

}  // namespace
}  // namespace vpm
