// Grids whose tables lie in memory of somebody else's: they are the grids that were packed there.
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "support/aligned_bytes.h"
#include "support/grids.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/medium/grid/density_grid.h"
#include "vpm/medium/grid/make_grid.h"

namespace vpm {
namespace {

constexpr int kHalfWidth = 20;

/// Voxels of noise, some of them 0, in one box or in two that lie far apart.
std::shared_ptr<const DensityGrid> grid_of(Interpolation interpolation, float background, bool two_boxes) {
  GridFrame frame = centered_frame(kHalfWidth, 0.1, interpolation);
  frame.background = background;
  std::vector<IndexBox> clouds{{frame.lo, frame.hi}};
  if (two_boxes) {
    clouds.push_back({frame.lo + 100'000, frame.hi + 100'000});
    frame.hi += 100'000;
  }
  return std::make_shared<const DensityGrid>(
      frame,
      [&](const Vec3i& origin, float* values) {
        for (int n = 0; n < DensityGrid::kBrickValues; ++n) {
          const Vec3i p = origin + Vec3i(n % 9, n / 9 % 9, n / 81);
          values[n] = background;
          for (const IndexBox& box : clouds)
            if (glm::all(glm::greaterThanEqual(p, box.lo)) && glm::all(glm::lessThanEqual(p, box.hi)))
              values[n] = std::max(0.0f, static_cast<float>(lattice_noise(p.x, p.y, p.z)) - 0.3f);
        }
        return DensityGrid::Filled::all;
      },
      two_boxes ? clouds : std::vector<IndexBox>{});
}

std::shared_ptr<AlignedBytes> packed_bytes(const DensityGrid& grid) {
  TablePacker counter(nullptr);
  grid.pack(counter);
  auto memory = std::make_shared<AlignedBytes>(counter.bytes());
  TablePacker packer(memory->data());
  grid.pack(packer);
  return memory;
}

struct Walked {
  double length = 0.0, integral = 0.0;
  uint32_t pieces = 0, stretches = 0;
  bool operator==(const Walked&) const = default;
};

Walked walk(const DensityGrid& grid, const Ray& ray, const Interval& interval) {
  Walked all;
  all.pieces = grid.visit_pieces(ray, interval, [&](const DensityPiece& piece) {
    all.length += piece.t1 - piece.t0;
    all.integral += piece.integral(piece.t1 - piece.t0);
    return true;
  });
  all.stretches = grid.visit_majorants(ray, interval, [&](const DensityStretch& stretch) {
    all.integral += stretch.max * (stretch.t1 - stretch.t0);
    return true;
  });
  return all;
}

class PackedGrid : public testing::TestWithParam<std::tuple<Interpolation, float, bool>> {
 protected:
  const std::shared_ptr<const DensityGrid> grid_ = std::apply(grid_of, GetParam());
};
INSTANTIATE_TEST_SUITE_P(All, PackedGrid,
                         testing::Combine(testing::Values(Interpolation::trilinear, Interpolation::nearest),
                                          testing::Values(0.0f, 0.25f), testing::Bool()));

TEST_P(PackedGrid, TellsTheSameOfItself) {
  const auto packed = packed_bytes(*grid_);
  TableUnpacker unpacker(packed->bytes());
  const DensityGrid same(unpacker, packed);
  EXPECT_EQ(same.max_density(), grid_->max_density());
  EXPECT_EQ(same.mean_density(), grid_->mean_density());
  EXPECT_EQ(same.mean_of_stored(), grid_->mean_of_stored());
  EXPECT_EQ(same.extent(), grid_->extent());
  EXPECT_EQ(same.voxel_size(), grid_->voxel_size());
  EXPECT_EQ(same.bounds().lo, grid_->bounds().lo);
  EXPECT_EQ(same.bounds().hi, grid_->bounds().hi);
  EXPECT_EQ(same.frame().background, grid_->frame().background);
  EXPECT_GE(packed->bytes().size(), grid_->memory_bytes() - sizeof(DensityGrid));
}

TEST_P(PackedGrid, IsWalkedAndLookedUpAlikeOnceTheOtherIsGone) {
  std::shared_ptr<const DensityGrid> grid = std::apply(grid_of, GetParam());
  const auto packed = packed_bytes(*grid);
  grid.reset();
  TableUnpacker unpacker(packed->bytes());
  const DensityGrid same(unpacker, packed), second = same;  // a copy reads the same tables
  Rng rng(5, 0, 0);
  int varying = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 from = Vec3(rng.uniform(), rng.uniform(), rng.uniform()) * 5.0f - 2.5f;
    const Vec3 far = i % 2 && std::get<2>(GetParam()) ? Vec3(10'000.0f) : Vec3(0.0f);  // of the second box
    const Ray ray{from + far, uniform_sphere(Vec2(rng.uniform(), rng.uniform()))};
    EXPECT_EQ(same.density(ray.origin), grid_->density(ray.origin));
    EXPECT_EQ(second.density(ray.origin), grid_->density(ray.origin));
    const Box box{ray.origin - 0.3f, ray.origin + 0.1f};
    EXPECT_EQ(same.is_positive(box), grid_->is_positive(box));
    std::array<float, DensityGrid::kAtOnce> at_once{}, expected{};
    same.densities(same.lattice_ray(ray), -1.0, 0.2, at_once);
    grid_->densities(grid_->lattice_ray(ray), -1.0, 0.2, expected);
    EXPECT_EQ(at_once, expected);
    const Walked walked = walk(same, ray, {0.0f, 6.0f});
    EXPECT_EQ(walked, walk(*grid_, ray, {0.0f, 6.0f}));
    varying += walked.integral > 0.0;
  }
  EXPECT_GT(varying, 150);
}

TEST_P(PackedGrid, KeepsNoTablesOfItsOwn) {
  const auto packed = packed_bytes(*grid_);
  TableUnpacker unpacker(packed->bytes());
  const DensityGrid same(unpacker, packed);
  const std::byte* const begin = packed->bytes().data();
  const auto lies_there = [&](const void* address) {
    return address >= begin && address < begin + packed->bytes().size();
  };
  int stretches = 0;
  same.visit_majorants({Vec3(-3.0f, 0.01f, 0.02f), Vec3(1.0f, 0.0f, 0.0f)}, {0.0f, 6.0f},
                       [&](const DensityStretch& stretch) {
                         if (!stretch.values) return true;
                         ++stretches;
                         EXPECT_TRUE(lies_there(stretch.values));
                         EXPECT_TRUE(lies_there(stretch.blocks));
                         return true;
                       });
  EXPECT_GE(stretches, 4);
  const Vec3 middle(0.03f, 0.04f, 0.05f);
  ASSERT_GT(same.density(middle), 0.0f);
  packed->wipe();  // its bricks, too
  EXPECT_NE(same.density(middle), grid_->density(middle));
}

}  // namespace
}  // namespace vpm
