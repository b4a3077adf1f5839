// Grids of any kind: empty, of one voxel, millions of voxels wide, of needles; densities at the end of what float
// holds; rays along every face and edge.
#include <cstring>

#include "hard/hard_scenes.h"
#include "vpm/base/error.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/base/warp.h"

namespace vpm {
namespace {

GridFrame frame_of(const Vec3i& lo, const Vec3i& hi, const Vec3d& voxel = Vec3d(1.0)) {
  GridFrame frame;
  frame.lo = lo;
  frame.hi = hi;
  frame.index_to_world = glm::scale(Mat4d(1.0), voxel);
  return frame;
}

double integral_of(const std::shared_ptr<const DensityGrid>& grid, const Ray& ray, const Interval& interval = {}) {
  return density_integral(make_medium(grid, Rgb(1.0f)), ray, interval).value;
}

TEST(GridsExtremes, AnEmptyGridIsVacuum) {
  const auto empty = make_grid(frame_of(Vec3i(-9), Vec3i(9), Vec3d(0.25)), [](int, int, int) { return 0.0; });
  EXPECT_EQ(empty->max_density(), 0.0f);
  EXPECT_EQ(empty->mean_density(), 0.0);
  for (const StrategyInfo& info : distance_strategies()) {
    if (!info.heterogeneous || !info.positive) continue;
    const Ledger ledger = clean_ledger(boxed_medium(make_medium(empty, Rgb(1e9f), 0.5f), PointLight{Vec3(3, 0, 0)}),
                                       std::string(info.name), 1000);
    EXPECT_EQ(ledger.collisions, 0u) << info.name;
    EXPECT_NEAR(ledger.escaped.r / ledger.emitted.r, 1.0, 1e-6) << info.name;
  }
  for (const DirectLight direct : {DirectLight::photons, DirectLight::shadow_rays})
    for (const VolumeForm form : {VolumeForm::density_at_query, VolumeForm::density_at_photon}) {
      Scene scene = boxed_medium(make_medium(empty, Rgb(1e9f), 0.5f), ConstantEnvironment{Rgb(1.0f)});
      scene.camera = make_camera(Vec3(0, 0, 4), Vec3(0.0f), Vec3(0, 1, 0), 30.0f, {4, 4});
      RenderSettings settings = settings_of(1000, 0.1f);
      settings.single_scattering.type = direct;
      settings.volume.form = form;
      for (const Rgb& pixel : clean_image(scene, settings).pixels) EXPECT_EQ(pixel, Rgb(1.0f));
    }
}

TEST(GridsExtremes, OneVoxelIsATentOrABox) {
  Worst worst("relative error of density integrals");
  for (const double size : {1e-5, 1.0, 1e5}) {
    GridFrame frame = frame_of(Vec3i(0), Vec3i(0), Vec3d(size, 2 * size, 3 * size));
    const auto tent = make_grid(frame, [](int, int, int) { return 4.0; });
    frame.interpolation = Interpolation::nearest;
    const auto box = make_grid(frame, [](int, int, int) { return 4.0; });
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 direction(0.0f), origin(0.0f);
      direction[axis] = 1.0f;
      origin[axis] = static_cast<float>(-10.0 * size);
      const double edge = (axis + 1) * size;
      worst.see(integral_of(tent, {origin, direction}) / (4.0 * edge) - 1.0);
      EXPECT_NEAR(integral_of(tent, {origin, direction}) / (4.0 * edge), 1.0, 1e-6);  // the tent's triangle
      EXPECT_NEAR(integral_of(box, {origin, direction}) / (4.0 * edge), 1.0, 1e-6);
    }
    EXPECT_FLOAT_EQ(static_cast<float>(tent->mean_density()), 0.5f);  // 4 over 2^3 cells
    EXPECT_FLOAT_EQ(static_cast<float>(box->mean_density()), 4.0f);
    EXPECT_FLOAT_EQ(tent->density(Vec3(0.0f)), 4.0f);
    // The density integral along the space diagonal, by (1 - s)^3 on both sides of the middle.
    const Vec3 diagonal(Vec3d(size, 2 * size, 3 * size));
    const double length = glm::length(Vec3d(diagonal));
    EXPECT_NEAR(integral_of(tent, {-2.0f * diagonal, glm::normalize(diagonal)}) / (2.0 * length), 1.0, 1e-5);
  }
}

TEST(GridsExtremes, MillionsOfVoxelsWideKeepEverySpike) {
  constexpr int kWide = 1'000'000;
  // One row of bricks: two spikes of one voxel, each read within its own brick or two.
  const auto spikes = make_grid(frame_of(Vec3i(1, 1, 1), Vec3i(kWide, 7, 7), Vec3d(0.01)),
                                [](int x, int, int) { return x == 3 || x == kWide - 5 ? 5.0 : 0.0; });
  EXPECT_LT(spikes->memory_bytes(), 8u << 20);
  for (const float from : {-1.0f, 10001.0f}) {
    const Ray ray{Vec3(from, 0.04f, 0.04f), Vec3(from < 0.0f ? 1 : -1, 0, 0)};
    uint32_t read = 0;
    const Medium medium = make_medium(spikes, Rgb(1.0f));
    const DensityIntegral crossed = density_integral(medium, ray, {});
    read = crossed.lookups;
    EXPECT_NEAR(crossed.value, 2 * 5.0 * 0.01, 1e-9);
    EXPECT_LE(read, 32u);
    EXPECT_NEAR(density_integral(medium, ray, {0.0f, 5000.0f}).value, 5.0 * 0.01, 1e-9);
  }
  // A billion is refused before anything is allocated.
  bool asked = false;
  const auto fill = [&](const Vec3i&, float*) {
    asked = true;
    return DensityGrid::Filled::one;
  };
  GridFrame frame = frame_of(Vec3i(1, 1, 1), Vec3i(1'000'000'000, 7, 7));
  EXPECT_THROW(DensityGrid(frame, fill), InputError);
  frame = frame_of(Vec3i(-1'000'000'000), Vec3i(1'000'000'000));
  EXPECT_THROW(DensityGrid(frame, fill), InputError);
  EXPECT_FALSE(asked);
}

TEST(GridsExtremes, VoxelsOfOneToAThousandAreIntegratedExactly) {
  // A product of three functions, each linear between the lattice's points: density integrals of any ray against fine
  // quadrature, and the photons that get through.
  Worst worst("relative difference from quadrature in 4000 steps");
  for (const Vec3d& voxel : {Vec3d(1.0, 1e-3, 1e-3), Vec3d(1e-3, 1.0, 1.0), Vec3d(1e-3, 1e-3, 1.0)}) {
    const auto grid =
        make_grid(frame_of(Vec3i(0), Vec3i(12), voxel), [](int x, int y, int z) { return lattice_noise(x, y, z); });
    Rng rng(1, rng_stream(RngUse::test, 0), 0);
    for (int i = 0; i < 50; ++i) {
      const Vec3 a(voxel * (12.0 * Vec3d(rng.uniform(), rng.uniform(), rng.uniform())));
      const Vec3 b(voxel * (12.0 * Vec3d(rng.uniform(), rng.uniform(), rng.uniform())));
      const float length = glm::distance(a, b);
      const Ray ray{a, glm::normalize(b - a)};
      double sum = 0.0;
      constexpr int kSteps = 4000;
      for (int k = 0; k < kSteps; ++k) sum += grid->density(ray.at(static_cast<float>((k + 0.5) / kSteps) * length));
      worst.see(integral_of(grid, ray, {0.0f, length}) / (sum * length / kSteps) - 1.0);
      EXPECT_NEAR(integral_of(grid, ray, {0.0f, length}) / (sum * length / kSteps), 1.0, 1e-3);
    }
  }
}

/// Quadrature-free truth: the density integral of a field linear in all directions is the density at the middle times
/// the length.
TEST(GridsExtremes, RaysAlongFacesEdgesAndCornersSeeTheField) {
  const auto grid = make_grid(frame_of(Vec3i(0), Vec3i(24)), [](int x, int y, int z) { return 1 + x + 2 * y + 3 * z; });
  const auto linear = [](const Vec3d& p) { return 1.0 + p.x + 2.0 * p.y + 3.0 * p.z; };
  std::vector<Vec3> starts;  // corners of bricks and cells, middles of their edges and faces
  for (const float x : {0.0f, 4.0f, 8.0f, 8.5f})
    for (const float y : {0.0f, 4.5f, 16.0f})
      for (const float z : {0.0f, 8.0f, 15.5f}) starts.emplace_back(x, y, z);
  const float zero = 0.0f, tiny = 1e-38f;
  Worst worst("relative error of density integrals");
  for (const Vec3& start : starts)
    for (const Vec3& d :
         {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, -zero, -zero), Vec3(-zero, 1, -zero), Vec3(1, 1, 0),
          Vec3(1, 0, 1), Vec3(0, 1, 1), Vec3(1, 1, 1), Vec3(1, tiny, -tiny), Vec3(-tiny, 1, tiny), Vec3(1, 2, 0)}) {
      const Vec3 direction = glm::normalize(d);
      const float length = 7.0f;
      const double exact = linear(Vec3d(start) + 3.5 * Vec3d(direction)) * length;
      worst.see(integral_of(grid, {start, direction}, {0.0f, length}) / exact - 1.0);
      EXPECT_NEAR(integral_of(grid, {start, direction}, {0.0f, length}), exact, 1e-5 * exact)
          << start.x << " " << start.y << " " << start.z << " along " << d.x << " " << d.y << " " << d.z;
      EXPECT_NEAR(integral_of(grid, {start + length * direction, -direction}, {0.0f, length}), exact, 1e-5 * exact);
    }
}

TEST(GridsExtremes, RaysAlongTheBorderOfTheSupportEndThere) {
  GridFrame frame = frame_of(Vec3i(0), Vec3i(15));
  frame.interpolation = Interpolation::nearest;  // fills [-1/2, 15 1/2]^3
  const auto grid = make_grid(frame, [](int, int, int) { return 1.0; });
  for (const float side : {-0.5f, 15.5f})
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 direction(0.0f), origin(side);
      direction[axis] = 1.0f;
      origin[axis] = -3.0f;
      const double along = integral_of(grid, {origin, direction});
      EXPECT_TRUE(std::abs(along) < 1e-12 || std::abs(along - 16.0) < 1e-12) << along;  // a face is inside or outside
      origin[axis] = 20.0f;
      EXPECT_NEAR(integral_of(grid, {origin, -direction}), along, 1e-12);
    }
}

/// Smoke in a box before a panel, densities times `factor` and sigma_t over it.
Scene smoke_of(float factor) {
  GridFrame frame = frame_of(Vec3i(-8), Vec3i(8), Vec3d(0.125));
  const auto grid = make_grid(frame, [&](int x, int y, int z) {
    const auto density = static_cast<float>(lattice_noise(x, y, z));
    return x > 5 ? 0.0f : density * density * factor;
  });
  Scene scene = boxed_medium(make_medium(grid, Rgb(2.0f, 3.0f, 4.0f) / factor, 0.5f),
                             PointLight{Vec3(0.5f, 1.5f, 0.5f), Rgb(9.0f)});
  scene.camera = make_camera(Vec3(0, 0.5f, 4), Vec3(0.0f), Vec3(0, 1, 0), 30.0f, {12, 12});
  return scene;
}

TEST(GridsExtremes, DensitiesAtTheEndsOfFloatGiveTheSamePicture) {
  Worst worst("relative error of the picture in denormal densities");
  for (const VolumeForm form : {VolumeForm::density_at_query, VolumeForm::density_at_photon})
    for (const DirectLight direct : {DirectLight::photons, DirectLight::shadow_rays})
      for (const char* gather : {"radius", "nearest"}) {
        RenderSettings settings = settings_of(4000, 0.125f);
        settings.volume.form = form;
        settings.single_scattering.type = direct;
        settings.volume.choose(gather);
        const Image benign = clean_image(smoke_of(1.0f), settings);
        EXPECT_GT(mean_of(benign), 1e-3);
        // 7.9e-31 and 1.3e30; powers of two, so that every bit is the same.
        for (const float factor : {0x1p-100f, 0x1p-60f, 0x1p60f, 0x1p100f}) {
          const Image image = clean_image(smoke_of(factor), settings);
          EXPECT_EQ(std::memcmp(image.pixels.data(), benign.pixels.data(), benign.pixels.size() * sizeof(Rgb)), 0)
              << factor << " form " << static_cast<int>(form) << " direct " << static_cast<int>(direct);
        }
        // All but the largest densities below 1.2e-38 are denormal, and keep fewer digits.
        const double denormal = mean_of(clean_image(smoke_of(0x1p-125f), settings)) / mean_of(benign);
        EXPECT_NEAR(denormal, 1.0, 1e-3);
        worst.see(denormal - 1.0);
      }
}

TEST(GridsExtremes, DenormalVoxelsAmongOthersAreNothing) {
  // Where float keeps no more, what is left of the smoke's tail changes no picture.
  const auto tail = [](float least) {
    return make_grid(frame_of(Vec3i(-8), Vec3i(8), Vec3d(0.125)),
                     [=](int x, int, int) { return x < 0 ? 1.0f : least; });
  };
  const auto pictures = [&](float least, const char* strategy, int passes) {
    Scene scene = boxed_medium(make_medium(tail(least), Rgb(3.0f), 0.8f), PointLight{Vec3(2.0f, 0, 0), Rgb(4.0f)});
    scene.camera = make_camera(Vec3(1, 0, 4), Vec3(0.2f, 0, 0), Vec3(0, 1, 0), 30.0f, {8, 8});
    RenderSettings settings = settings_of(2000, 0.2f);
    settings.distance.strategy = strategy;
    return clean_means(scene, settings, passes);
  };
  for (const char* strategy : {"regular", "ray-march"}) {
    const Moments without = pictures(0.0f, strategy, 24);
    for (const float least : {1e-45f, 1e-40f, 1e-30f}) {
      const Moments with = pictures(least, strategy, 24);
      const double error = std::sqrt(with.variance_of_mean() + without.variance_of_mean());
      EXPECT_GT(student_tail((with.mean() - without.mean()) / error, 46.0), kFalseAlarms) << strategy << " " << least;
    }
  }
  for (const char* strategy : {"mean-extinction", "local-extinction"})
    for (const float least : {1e-45f, 1e-40f, 1e-30f}) pictures(least, strategy, 1);  // clean, though heavy-tailed
}

}  // namespace
}  // namespace vpm
