// What Blender makes of a picture with layers: names of layers and passes, and the values of a pixel. Skipped where
// there is no Blender.
#include <fmt/format.h>

#include <array>
#include <map>
#include <sstream>

#include "tools/vpm_binary.h"
#include "vpm/image/exr.h"

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
integrator = "path"
passes = 3
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
  /// What Blender shows of the pixel.
  std::map<std::string, Pixel> shown_by(const std::string& blender, const std::string& picture) const {
    const std::string script = std::string(VPM_SOURCE_DIR) + "/tests/tools/blender_layers.py";
    const auto text = [](int number) { return std::to_string(number); };
    const ProcessResult run = run_program(
        {blender, "-b", "--factory-startup", "--python-exit-code", "1", "--python", script, "--", path(picture),
         text(kFilmWidth), text(kFilmHeight), text(kPixelX), text(kPixelY), folder_.string()},
        {300.0, 0, folder_.string()});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    return passes_in(run.out);
  }
};

TEST_F(SlowVpmBlender, ShowsLayersByTheirNames) {
  const std::optional<std::string> blender = program_in_path({"blender"});
  if (!blender) GTEST_SKIP() << "there is no Blender";
  write("scene.toml", kFogAndFloor);
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--layers",
                "depth,normal,albedo,transmittance,single-scattering-albedo,samples"});
  const std::map<std::string, Pixel> shown = shown_by(*blender, "a.exr");
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

}  // namespace
}  // namespace vpm
