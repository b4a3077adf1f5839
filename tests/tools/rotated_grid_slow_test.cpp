// A grid with a rotated transform against its own copy on an unrotated lattice: the same density integrals, the same
// picture.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "vpm/base/rng.h"
#include "vpm/base/statistics.h"
#include "vpm/base/tails.h"
#include "vpm/base/warp.h"
#include "vpm/input/grid_file.h"
#include "vpm/input/scene_file.h"
#include "vpm/render/photon_pass.h"

namespace vpm {
namespace {

constexpr int kWidth = 32, kHeight = 24, kBlock = 4;
constexpr int kPasses = 48;

/// Writes a grid whose voxels lie along the axes of the world, `voxel` m apart, with the density that the grid of
/// `source` has there by OpenVDB's own sampler.
void write_unrotated_copy(const std::string& source, const Box& box, double voxel, const std::string& path) {
  openvdb::io::File file(source);
  file.open();
  const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("density"));
  const auto values = grid->getConstAccessor();
  const openvdb::tools::GridSampler<openvdb::FloatGrid::ConstAccessor, openvdb::tools::BoxSampler> sampler(
      values, grid->transform());
  const auto corner = [&](const Vec3& p, double (*round)(double)) {
    return openvdb::Coord(int(round(p.x / voxel)), int(round(p.y / voxel)), int(round(p.z / voxel)));
  };
  openvdb::FloatGrid::Ptr copy = openvdb::FloatGrid::create(0.0f);
  copy->setName("density");
  copy->setGridClass(openvdb::GRID_FOG_VOLUME);
  copy->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
  auto accessor = copy->getAccessor();
  for (const openvdb::Coord& c : openvdb::CoordBBox(corner(box.lo, std::floor), corner(box.hi, std::ceil))) {
    const float density = sampler.wsSample(c.asVec3d() * voxel);
    if (density > 0.0f) accessor.setValue(c, density);
  }
  openvdb::io::File(path).write({copy});
}

/// What the copy differs by, along random lines through the grid.
struct DensityIntegralDifference {
  double mean = 0.0;     // m, of the grid's density integrals
  double bias = 0.0;     // relative difference of the mean density integrals
  double typical = 0.0;  // mean absolute difference over the mean density integral
  double worst = 0.0;    // m
};
DensityIntegralDifference compare_integrals(const Medium& grid, const Medium& copy, int rays) {
  const Box box = grid.grid->bounds();
  const float radius = 0.5f * box.diagonal();
  DensityIntegralDifference result;
  double other = 0.0;
  for (int i = 0; i < rays; ++i) {
    Rng rng(1, 2, static_cast<uint64_t>(i));
    const Vec3 direction = uniform_sphere(rng.uniform2());
    const Vec3 through =
        box.lo + (Vec3(0.3f) + 0.4f * Vec3(rng.uniform(), rng.uniform(), rng.uniform())) * box.extent();
    const Ray ray{through - radius * direction, direction};
    const Interval whole{0.0f, 2.0f * radius};
    const double a = density_integral(grid, ray, whole).value, b = density_integral(copy, ray, whole).value;
    result.mean += a / rays;
    other += b / rays;
    result.typical += std::abs(a - b) / rays;
    result.worst = std::max(result.worst, std::abs(a - b));
  }
  result.typical /= result.mean;
  result.bias = other / result.mean - 1.0;
  return result;
}

/// Moments over passes of the mean radiance of the whole picture (first) and of each block of pixels.
std::vector<Moments> block_moments(const RenderJob& loaded) {
  const int integrals = kWidth / kBlock;
  std::vector<Moments> moments(1 + integrals * (kHeight / kBlock));
  for (int pass = 0; pass < kPasses; ++pass) {
    const Image image = render_photon_pass(loaded.scene, loaded.settings, pass).image;
    std::vector<double> means(moments.size());
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        means[0] += image.at(x, y).g / (kWidth * kHeight);
        means[1 + (y / kBlock) * integrals + x / kBlock] += image.at(x, y).g / (kBlock * kBlock);
      }
    for (size_t i = 0; i < means.size(); ++i) moments[i].add(means[i]);
  }
  return moments;
}

// Density at the photon: that estimate is linear in the density, while density at the query depends on where the
// density is exactly zero, which no copy keeps.
class RotatedGrid : public ::testing::Test {
 protected:
  RotatedGrid() {
    openvdb::initialize();
    std::filesystem::create_directories(folder_);
  }
  ~RotatedGrid() override { std::filesystem::remove_all(folder_); }

  RenderJob scene(const std::string& grid, int seed) const {
    const std::string path = (folder_ / "scene.toml").string();
    std::ofstream(path) << fmt::format(R"(
[camera]
position = [6, 12, 28]
target = [-2.9, 4.9, 2.4]
fov = 38
[film]
width = {}
height = {}
[media.fog]
type = "grid"
path = "{}"
sigma_t = 0.8
albedo = 0.9
[[lights]]
type = "spot"
position = [10, 25, 18]
target = [-2.9, 4.9, 2.4]
outer_angle = 22
power = 20000
[render]
radii = "constant"
samples_per_pixel = 8
seed = {}
[photons]
emitted = 20_000
[volume]
radius = 0.4
form = "density-at-photon"
)",
                                       kWidth, kHeight, grid, seed);
    return load_scene(path);
  }

  const std::filesystem::path folder_ = std::filesystem::path(::testing::TempDir()) / "rotated_grid";
};

TEST_F(RotatedGrid, LooksAsItsUnrotatedCopy) {
  const std::string dragon = std::string(VPM_SHARED_DIR) + "/vdb/edge/affine_rotated_dragon.vdb";
  if (!std::filesystem::exists(dragon)) GTEST_SKIP() << "the rotated grid is not here";
  GridRequest request;
  request.path = dragon;
  const auto grid = load_grid(request).grid;
  const std::string copy = (folder_ / "copy.vdb").string();
  write_unrotated_copy(dragon, grid->bounds(), 0.5 * grid->voxel_size(), copy);

  const RenderJob rotated = scene(dragon, 1), unrotated = scene(copy, 2);
  const DensityIntegralDifference integrals = compare_integrals(rotated.scene.media[0], unrotated.scene.media[0], 1000);
  EXPECT_GT(integrals.mean, 0.1);
  EXPECT_LT(std::abs(integrals.bias), 0.002);
  EXPECT_LT(integrals.typical, 0.005);
  EXPECT_LT(integrals.worst, 0.5 * grid->voxel_size());

  // z-tests over passes, of the whole picture and of its blocks, with a false-alarm rate of 1e-6 each. Resampling adds
  // at most what it adds to the density integrals: light that scatters grows less than the density integral does.
  const std::vector<Moments> a = block_moments(rotated), b = block_moments(unrotated);
  int lit = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double error = std::sqrt(a[i].variance_of_mean() + b[i].variance_of_mean());
    const double resampling = (i == 0 ? std::abs(integrals.bias) : 2.0 * integrals.typical) * a[i].mean();
    EXPECT_LE(std::abs(a[i].mean() - b[i].mean()), normal_quantile(1e-6) * error + resampling)
        << "block " << i << ": " << a[i].mean() << " and " << b[i].mean() << " +- " << error;
    EXPECT_LT(error, (i == 0 ? 0.005 : 1.0) * std::max(a[i].mean(), a[0].mean()));
    lit += i > 0 && a[i].mean() > 0.0;
  }
  EXPECT_GT(lit, 12);
}

}  // namespace
}  // namespace vpm
