// Awkward .vdb files through the program: what can be a density renders, everything else is refused soon, clearly and
// without absurd memory.
#include <fmt/format.h>
#include <filesystem>

#include "support/statistics.h"
#include "tools/vpm_binary.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/image/exr.h"
#include "vpm/input/scene_file.h"
#include "vpm/integrators/photon_map/photon_pass.h"

namespace vpm {
namespace {

constexpr int kWidth = 32, kHeight = 24;

/// A scene that shows something of width `size` at `center` in black space, lit by a light from the upper right.
/// `medium` has the keys of its fog.
std::string view_of(const Vec3d& center, double size, const std::string& medium) {
  const Vec3d camera = center + Vec3d(0.0, 0.0, 1.6 * size), lamp = center + size * Vec3d(0.8, 1.0, 0.8);
  const auto text = [](const Vec3d& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); };
  return fmt::format(R"(
[camera]
position = {}
target = {}
fov = 45
[film]
width = {}
height = {}
[[lights]]
type = "spot"
position = {}
target = {}
outer_angle = 32
intensity = {}
[render]
passes = 1
[integrator.photons]
emitted = 20_000
[integrator.volume]
radius = {}
[integrator.single_scattering]
type = "shadow-rays"
[media.fog]
{})",
                     text(camera), text(center), kWidth, kHeight, text(lamp), text(center), size * size, 0.03 * size,
                     medium);
}

std::string grid_medium(const std::string& file, const std::string& grid, double sigma_t) {
  return fmt::format("type = \"grid\"\npath = \"{}\"\ngrid = \"{}\"\nsigma_t = {}\nalbedo = 0.9\n", file, grid,
                     sigma_t);
}

bool is_lit(const Image& image, int x, int y) { return !is_black(image.at(x, y)); }

/// The pixels that are not black.
int lit_pixels(const Image& image) {
  int lit = 0;
  for (const Rgb& c : image.pixels) {
    EXPECT_TRUE(is_finite(c));
    lit += !is_black(c);
  }
  return lit;
}

bool border_is_black(const Image& image) {
  for (int x = 0; x < kWidth; ++x)
    if (is_lit(image, x, 0) || is_lit(image, x, kHeight - 1)) return false;
  for (int y = 0; y < kHeight; ++y)
    if (is_lit(image, 0, y) || is_lit(image, kWidth - 1, y)) return false;
  return true;
}

class VpmFiles : public VpmBinary {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(edge(""))) GTEST_SKIP() << "the awkward grids are not here";
  }
  /// A render of the grid says that there is nothing, and is black.
  void expect_vacuum(const std::string& file, const std::string& grid) const {
    write("scene.toml", view_of(Vec3d(0.0), 4.0, grid_medium(file, grid, 1.0)));
    const std::string said = vpm_succeeds({"render", "scene.toml"}).err;
    EXPECT_NE(said.find("grid '" + grid + "' has no active voxels: it is vacuum"), std::string::npos) << said;
    EXPECT_EQ(lit_pixels(read_exr(path("scene.exr"))), 0);
  }
  static std::string edge(const std::string& name) { return std::string(VPM_SHARED_DIR) + "/vdb/edge/" + name; }

  Image render(const std::string& scene) const {
    write("scene.toml", scene);
    const ProcessResult result = vpm({"render", "scene.toml", "-o", "a.exr"}, 60.0, kAddressSpace);
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    EXPECT_LT(result.peak_memory, uint64_t{1} << 30);
    return read_exr(path("a.exr"));
  }
  void refuses(const std::string& file, const std::string& grid, const std::vector<std::string>& words) const {
    write("scene.toml", view_of(Vec3d(0.0), 1.0, grid_medium(file, grid, 1.0)));
    vpm_refuses({"render", "scene.toml"}, words, kAddressSpace);
  }
};

TEST_F(VpmFiles, ARotatedGridRenders) {
  const Image image =
      render(view_of({-2.9, 4.9, 2.4}, 22.0, grid_medium(edge("affine_rotated_dragon.vdb"), "density", 1.0)));
  EXPECT_TRUE(border_is_black(image));
  EXPECT_GT(lit_pixels(image), 30);
  EXPECT_LT(lit_pixels(image), kWidth * kHeight / 2);
}

TEST_F(VpmFiles, ADoubleGridRenders) {
  const Image image = render(view_of({-0.5, -0.5, 31.5}, 140.0, grid_medium(edge("double_grid.vdb"), "density", 1.0)));
  EXPECT_TRUE(border_is_black(image));
  EXPECT_GT(lit_pixels(image), 0);
}

TEST_F(VpmFiles, AGridOfAnotherNameRenders) {
  const Image image = render(view_of({-5.85, 0.0, 4.64}, 9.0,
                                     grid_medium(edge("other_name_voxel_fog_density.vdb"), "voxel_fog_density", 0.05)));
  EXPECT_TRUE(border_is_black(image));
  EXPECT_TRUE(is_lit(image, kWidth / 2, kHeight / 2));
}

TEST_F(VpmFiles, OneOfSeveralGridsOfANameRenders) {
  // Seen from before the second grid, about x = 2; the first lies to the right, at x = 4, the third to the left, at x =
  // 0.
  const auto middle = [&](const std::string& grid, int x) {
    return is_lit(render(view_of({2.0, 0.0, 0.0}, 3.0, grid_medium(edge("duplicate_names.vdb"), grid, 2.0))), x,
                  kHeight / 2);
  };
  const int left = kWidth / 2 - 12, right = kWidth / 2 + 12;  // pixels of 0.165 m at the grids' distance
  EXPECT_TRUE(middle("density[1]", kWidth / 2));
  EXPECT_FALSE(middle("density[1]", right));
  EXPECT_TRUE(middle("density[0]", right));
  EXPECT_FALSE(middle("density[0]", kWidth / 2));
  EXPECT_TRUE(middle("density[2]", left));
}

constexpr const char* kShell = R"(
[[shapes]]
type = "box"
min = [-1, -1, -1]
max = [1, 1, 1]
material = { type = "boundary" }
inside = "fog"
)";

TEST_F(VpmFiles, ABackgroundFillsTheShapeAroundIt) {
  // The values are 1 and so is the background: within a box, the grid is a homogeneous medium.
  const std::string grid =
      view_of(Vec3d(0.0), 4.0, grid_medium(edge("background_one_box.vdb"), "density", 0.8)) + kShell;
  const std::string same = view_of(Vec3d(0.0), 4.0, "type = \"homogeneous\"\nsigma_t = 0.8\nalbedo = 0.9\n") + kShell;
  const Image image = render(grid);
  EXPECT_TRUE(border_is_black(image));
  EXPECT_TRUE(
      is_lit(image, kWidth / 2 + 4, kHeight / 2));  // 0.8 m beside the middle: outside the grid's own box of 1 m

  const auto totals = [&](const std::string& name, const std::string& text, uint64_t seed) {
    write(name, text);
    RenderJob loaded = load_scene(path(name));
    loaded.settings.seed = seed;
    Moments moments;
    for (int pass = 0; pass < 32; ++pass) {
      double total = 0.0;
      for (const Rgb& c : render_photon_pass(loaded.scene, loaded.settings, 0).image.pixels) total += c.g;
      moments.add(total);
      ++loaded.settings.seed;
    }
    return moments;
  };
  const Moments a = totals("grid.toml", grid, 1), b = totals("same.toml", same, 1001);
  const double error = std::sqrt(a.variance_of_mean() + b.variance_of_mean());
  EXPECT_LT(std::abs(a.mean() - b.mean()), normal_quantile(1e-5) * error)
      << a.mean() << " and " << b.mean() << " +- " << error;
  EXPECT_LT(error, 0.01 * a.mean());
}

TEST_F(VpmFiles, ABackgroundWithoutAShapeIsRefused) {
  refuses(edge("background_one_box.vdb"), "density", {"background", "shape", "holds: density (float, fog volume)"});
}

TEST_F(VpmFiles, AmbiguousAndUnknownNamesAreRefusedWithTheList) {
  for (const char* name : {"density", "density[3]", "smoke"})
    refuses(edge("duplicate_names.vdb"), name,
            {name,
             "holds: density[0] (float, fog volume), density[1] (float, fog volume), density[2] (float, fog volume)"});
  refuses(edge("other_name_voxel_fog_density.vdb"), "density", {"'density'", "holds: voxel_fog_density (float"});
}

TEST_F(VpmFiles, WhatIsNoDensityIsRefusedWithTheList) {
  refuses(edge("vec3_only_Cd.vdb"), "density", {"'density'", "holds: Cd (vec3s"});
  refuses(edge("vec3_only_Cd.vdb"), "Cd", {"vec3s", "one number a voxel"});
  refuses(edge("pointdata_only.vdb"), "density", {"'density'", "holds: points (ptdataidx32"});
  refuses(edge("pointdata_only.vdb"), "points", {"ptdataidx32", "one number a voxel"});
  refuses(edge("empty_density.vdb"), "smoke", {"holds: density (float", "velocity (vec3s", "obstacles (int32"});
  refuses(edge("../ls_sphere.vdb"), "ls_sphere",
          {"level set", "from_level_set", "holds: ls_sphere (float stored as half, level set)"});
}

TEST_F(VpmFiles, EmptyFramesAreVacuum) { expect_vacuum(edge("empty_density.vdb"), "density"); }

TEST_F(VpmFiles, DamagedFilesAreRefused) {
  const std::vector<std::pair<std::string, std::string>> bombs{{"damaged_bad-bbox-bomb_40ba.vdb", "bomb"},
                                                               {"damaged_bad-bbox-huge_2258.vdb", "huge"},
                                                               {"damaged_bad-bbox-inverted_3691.vdb", "inverted"}};
  for (const auto& [file, grid] : bombs) {
    refuses(edge(file), "density", {"'density'", "holds: " + grid + " (float"});
    expect_vacuum(edge(file), grid);
  }
  refuses(edge("damaged_truncated_14b0.vdb"), "density", {"truncated"});
  refuses(edge("lfs_pointer_text.vdb"), "density", {"git-lfs pointer"});
}

TEST_F(VpmFiles, ALevelSetBecomesAFogOnRequest) {
  const Image image = render(
      view_of(Vec3d(0.0), 8.0, grid_medium(edge("../ls_sphere.vdb"), "ls_sphere", 1.0) + "from_level_set = true\n"));
  EXPECT_TRUE(border_is_black(image));
  EXPECT_TRUE(is_lit(image, kWidth / 2, kHeight / 2));
}

TEST_F(VpmFiles, InfoLooksIntoEveryFile) {
  for (const auto& entry : std::filesystem::directory_iterator(edge(""))) {
    const std::string file = entry.path().string();
    const ProcessResult result = vpm({"info", file}, 10.0, kAddressSpace);
    const bool whole = file.find("truncated") == std::string::npos && file.find("lfs_pointer") == std::string::npos;
    EXPECT_EQ(result.status, whole ? 0 : 2) << file << "\n" << result.err;
    EXPECT_EQ(result.out.find("grid ") != std::string::npos, whole) << file;
    EXPECT_LT(result.peak_memory, uint64_t{1} << 30) << file;
  }
}

}  // namespace
}  // namespace vpm
