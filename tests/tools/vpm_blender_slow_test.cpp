// What Blender makes of vpm's pictures, and vpm of Blender's panoramas. Skipped where there is no Blender.
#include <fmt/format.h>

#include <array>
#include <map>
#include <sstream>

#include "tools/vpm_binary.h"
#include "vpm/base/rng.h"
#include "vpm/image/exr.h"
#include "vpm/image/metrics.h"

namespace vpm {
namespace {

constexpr int kFilmWidth = 12, kFilmHeight = 8, kPixelX = 7, kPixelY = 5;

/// A ball of fog before a floor and the sky.
const std::string kFogAndFloor = fmt::format(R"(
[camera]
position = [0, 1, 4]
target = [0, 0.5, 0]
[film]
width = {}
height = {}
[media.fog]
type = "homogeneous"
sigma_s = [0.2, 0.4, 0.8]
sigma_a = 0.2
[[shapes]]
type = "sphere"
material = {{ type = "boundary" }}
center = [0, 0.5, 0]
radius = 1
inside = "fog"
[[shapes]]
type = "quad"
material = {{ type = "lambertian", reflectance = [0.2, 0.5, 0.8] }}
corner = [-5, -1, 5]
edge_u = [10, 0, 0]
edge_v = [0, 0, -10]
[[lights]]
type = "point"
position = [1, 3, 2]
intensity = 9
[render]
passes = 3
[integrator]
type = "path"
)",
                                             kFilmWidth, kFilmHeight);

using Pixel = std::array<float, 3>;

/// Lines "pass 'LAYER' 'PASS' R G B", by "LAYER/PASS".
std::map<std::string, Pixel> passes_in(const std::string& printed) {
  std::map<std::string, Pixel> passes;
  std::istringstream lines(printed);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind, layer, pass;
    Pixel pixel{};
    if (words >> kind >> layer >> pass >> pixel[0] >> pixel[1] >> pixel[2] && kind == "pass")
      passes[layer.substr(1, layer.size() - 2) + "/" + pass.substr(1, pass.size() - 2)] = pixel;
  }
  return passes;
}

class SlowVpmBlender : public VpmBinary {
 protected:
  void SetUp() override {
    blender_ = program_in_path({"blender"});
    if (!blender_) GTEST_SKIP() << "there is no Blender";
  }
  /// What a script of ours prints in Blender.
  std::string run_in_blender(const std::string& script, const std::vector<std::string>& arguments) const {
    std::vector<std::string> command{*blender_,
                                     "-b",
                                     "--factory-startup",
                                     "--python-exit-code",
                                     "1",
                                     "--python",
                                     std::string(VPM_SOURCE_DIR) + "/tests/tools/" + script,
                                     "--"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const ProcessResult run = run_program(command, {300.0, 0, folder_.string()});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    return run.out;
  }
  /// What Blender shows of the pixel.
  std::map<std::string, Pixel> shown(const std::string& picture) const {
    const auto text = [](int number) { return std::to_string(number); };
    return passes_in(run_in_blender("blender_layers.py", {path(picture), text(kFilmWidth), text(kFilmHeight),
                                                          text(kPixelX), text(kPixelY), folder_.string()}));
  }

  std::optional<std::string> blender_;
};

TEST_F(SlowVpmBlender, ShowsLayersByTheirNames) {
  write("scene.toml", kFogAndFloor);
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--layers",
                "depth,normal,albedo,transmittance,single-scattering-albedo,samples"});
  const std::map<std::string, Pixel> shown = this->shown("a.exr");
  const ExrChannels file = read_exr_channels(path("a.exr"));
  const auto expect = [&](const std::string& pass, const std::vector<std::string>& channels) {
    ASSERT_TRUE(shown.contains(pass)) << pass << " is missing of " << ::testing::PrintToString(shown);
    for (size_t c = 0; c < 3; ++c) {
      const float value = file.planes.at(channels[std::min(c, channels.size() - 1)])[kPixelY * kFilmWidth + kPixelX];
      EXPECT_NEAR(shown.at(pass)[c], value, 1e-6f * (1.0f + std::abs(value))) << pass;
    }
  };
  expect("/Combined", {"R", "G", "B"});
  expect("/variance", {"variance.R", "variance.G", "variance.B"});
  expect("/depth", {"depth.Z"});
  expect("/normal", {"normal.X", "normal.Y", "normal.Z"});
  expect("/albedo", {"albedo.R", "albedo.G", "albedo.B"});
  expect("/transmittance", {"transmittance.R", "transmittance.G", "transmittance.B"});
  expect("/single-scattering-albedo",
         {"single-scattering-albedo.R", "single-scattering-albedo.G", "single-scattering-albedo.B"});
  expect("/samples", {"samples.X"});
  expect("/normal-variance", {"normal-variance.X", "normal-variance.Y", "normal-variance.Z"});
  expect("/albedo-variance", {"albedo-variance.R", "albedo-variance.G", "albedo-variance.B"});
  EXPECT_EQ(shown.at("/samples")[0], 3.0f);
}

/// Patches of colours that no turn or mirror image takes to each other. Blender's axes are vpm's (z, x, y).
TEST_F(SlowVpmBlender, SeesAPanoramaTheSameWayRound) {
  Image panorama(64, 32);
  for (int y = 0; y < panorama.height; ++y)
    for (int x = 0; x < panorama.width; ++x) {
      Rng rng(5, rng_stream(RngUse::test, 0), static_cast<uint64_t>(y / 4 * 16 + x / 4));
      panorama.at(x, y) = Rgb(0.1f) + Rgb(rng.uniform(), rng.uniform(), rng.uniform());
    }
  write_exr(path("panorama.exr"), panorama, {}, {});
  for (const auto& [x, y, z] : {std::array{"1", "0.3", "0.4"}, std::array{"-0.5", "-0.6", "-0.9"}}) {
    write(
        "scene.toml",
        fmt::format("[camera]\nposition = [0, 0, 0]\ntarget = [{}, {}, {}]\nfov = 60\n"
                    "[film]\nwidth = 24\nheight = 24\n"
                    "[render]\npasses = 64\n"
                    "[[lights]]\ntype = 'environment'\npath = 'panorama.exr'\n"
                    "[[shapes]]\ntype = 'sphere'\ncenter = [0, 50, 0]\nradius = 0.1\nmaterial = {{ type = 'mirror' }}\n"
                    "[integrator]\ntype = 'path'\n",
                    x, y, z));
    vpm_succeeds({"render", "scene.toml", "-o", "vpm.exr"});
    run_in_blender("blender_panorama.py", {path("panorama.exr"), path("blender.exr"), "24", "60", z, x, y});
    const Image ours = read_exr(path("vpm.exr")), theirs = read_exr(path("blender.exr"));
    Image mirrored = theirs;
    for (int row = 0; row < 24; ++row)
      for (int column = 0; column < 24; ++column) mirrored.at(column, row) = theirs.at(23 - column, row);
    EXPECT_LT(relative_mse(ours, theirs), 0.005);
    EXPECT_GT(relative_mse(ours, mirrored), 0.1);
  }
}

}  // namespace
}  // namespace vpm
