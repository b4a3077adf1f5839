// Which scenes are slabs, and the moments of their phase functions.
#include "vpm/study/exact/slab_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <vector>

#include "vpm/input/scene_file.h"
#include "vpm/study/exact/phase_moments.h"

namespace vpm {
namespace {

const std::string kSlab = R"(
camera = { position = [0, 5, 0], target = [0, 0, 0.1] }
media.mist = { type = "homogeneous", sigma_t = [1, 2, 4], albedo = [0.5, 0.9, 0.2] }
shapes = [{ type = "box", min = [-100, 1, -100], max = [100, 3, 100], inside = "mist", material = { type = "boundary" } }]
lights = [{ type = "beam", position = [0, 0, 0], direction = [0, 1, 0], radius = 0.01, power = 1 }]
integrator = { type = "photon-map", photons = { emitted = 100 }, volume = { type = "beam", radius = 0.1 } }
)";

std::optional<SlabScene> slab_with(const std::vector<std::string>& options) {
  return slab_of(load_scene(SceneText{"slab", kSlab}, options).scene);
}

TEST(SlabScene, HasTheDepthsOfItsChannelsAndFacesThatPointOutwards) {
  const std::optional<SlabScene> slab = slab_with({});
  ASSERT_TRUE(slab);
  EXPECT_EQ(slab->channels[0].tau, 2.0);
  EXPECT_EQ(slab->channels[2].tau, 8.0);
  EXPECT_NEAR(slab->channels[1].albedo, 0.9, 1e-7);
  const auto& reflected = std::get<PlaneDetector>(slab->faces[0].kind);
  EXPECT_EQ(reflected.normal.y, -1.0f) << "the light comes from below";
  EXPECT_EQ(reflected.point.y, 1.0f);
  EXPECT_EQ(std::get<PlaneDetector>(slab->faces[1].kind).point.y, 3.0f);
}

TEST(SlabScene, IsNoneWhereAnythingElseIs) {
  for (const char* option :
       {"shapes.0.max=[30, 3, 100]", "lights.0.position=[70, 0, 0]", "lights.0.position=[0, 2, 0]",
        "lights.0.direction=[0.1, 1, 0]", "shapes.0.material.type=\"mirror\"", "media.mist.sigma_t=[1, 0, 4]",
        "media.mist.phase={ type = \"henyey-greenstein\", g = 0.9995 }"})
    EXPECT_FALSE(slab_with({option})) << option;
}

TEST(SlabScene, OfParallelLightRepeatsItself) {
  const std::string sun = "lights=[{ type = \"directional\", direction = [0, -1, 0], irradiance = 1 }]";
  EXPECT_FALSE(slab_with({sun})) << "light reaches its sides";
  const std::optional<SlabScene> slab = slab_with({sun, "world.cyclic=[\"x\", \"z\"]"});
  ASSERT_TRUE(slab);
  EXPECT_EQ(std::get<PlaneDetector>(slab->faces[0].kind).point.y, 3.0f) << "the light comes from above";
}

// A closed shape whose medium is at all corners of its box, but not everywhere in it.
TEST(SlabScene, IsNoPlateWithAHole) {
  const std::string path = testing::TempDir() + "plate.obj";
  std::ofstream file(path);
  for (const int y : {1, 3})
    for (const int half : {100, 30})
      for (const auto& [x, z] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        file << "v " << x * half << " " << y << " " << z * half << "\n";
  const auto quad = [&](int a, int b, int c, int d) { file << "f " << a << " " << b << " " << c << " " << d << "\n"; };
  for (int i = 1; i <= 4; ++i) {
    const int next = i % 4 + 1;
    quad(i, next, next + 4, i + 4);            // below
    quad(i + 8, i + 12, next + 12, next + 8);  // above
    quad(i, i + 8, next + 8, next);            // around
    quad(i + 4, next + 4, next + 12, i + 12);  // in the hole
  }
  file.close();
  EXPECT_FALSE(slab_with({"shapes.0={ type = \"mesh\", path = \"" + path +
                          "\", inside = \"mist\", material = { type = \"boundary\" } }"}));
}

// Henyey and Greenstein's moments are powers of g; a table of it has them as far as it resolves the function.
TEST(TableMoments, AreThoseOfTheFunctionThatItHolds) {
  constexpr int kRows = 7201;
  for (const float g : {-0.5f, 0.0f, 0.85f}) {
    std::vector<double> degrees(kRows), values(kRows);
    for (int i = 0; i < kRows; ++i) {
      degrees[static_cast<size_t>(i)] = 180.0 * i / (kRows - 1.0);
      const double cosine = std::cos(degrees[static_cast<size_t>(i)] * kPiD / 180.0);
      values[static_cast<size_t>(i)] = std::pow(1.0 + double{g} * g - 2.0 * g * cosine, -1.5);
    }
    const exact::PhaseMoments moments = exact::table_moments(PhaseTable(degrees, values));
    ASSERT_GE(moments.size(), g == 0.0f ? 1u : 20u);
    for (size_t l = 0; l < std::min<size_t>(moments.size(), 64); ++l)
      EXPECT_NEAR(moments[l], std::pow(double{g}, static_cast<double>(l)), 2e-6) << "g " << g << ", moment " << l;
  }
}

TEST(MomentsOf, AreThoseOfEachPhaseFunction) {
  EXPECT_EQ(exact::moments_of(Rayleigh{}), exact::rayleigh_moments());
  for (const Phase& phase : {Phase(HenyeyGreenstein{0.7f}), Phase(Draine{0.3f, 2.0f}),
                             Phase(TwoLobes(0.8f, -0.3f, 0.7f)), Phase(Droplets(12.0f))}) {
    const exact::PhaseMoments moments = exact::moments_of(phase);
    const double mean = std::visit([](const auto& of) { return double{of.mean_cosine()}; }, phase);
    EXPECT_NEAR(moments[0], 1.0, 1e-12);
    EXPECT_NEAR(moments[1], mean, 1e-6);
  }
}

}  // namespace
}  // namespace vpm
