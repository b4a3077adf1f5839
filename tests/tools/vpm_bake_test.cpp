// Light maps from outside: what the files hold, where texels are, and what is refused.
#include <cstring>

#include "tools/vpm_binary.h"
#include "vpm/image/exr.h"

namespace vpm {
namespace {

/// A floor with a light over the end of both its edges, and shapes that no light map can be of.
constexpr const char* kBakedScene = R"(
[camera]
position = [0, 1, 3]
target = [0, 0, 0]
[materials.white]
type = "lambertian"
reflectance = 0.5
[materials.black]
type = "lambertian"
reflectance = 0
[[shapes]]
name = "floor"
type = "quad"
material = "white"
corner = [-1, 0, 1]
edge_u = [2, 0, 0]
edge_v = [0, 0, -2]
[[shapes]]
name = "ball"
type = "sphere"
material = "white"
center = [0, 0.5, 0]
radius = 0.2
[[shapes]]
name = "crate"
type = "box"
material = "white"
min = [-0.9, 0.1, -0.9]
max = [-0.5, 0.5, -0.5]
[[shapes]]
name = "soot"
type = "quad"
material = "black"
corner = [-1, 3, 1]
edge_u = [2, 0, 0]
edge_v = [0, 0, -2]
[[shapes]]
name = "glass"
type = "quad"
material = { type = "dielectric", ior = 1.5 }
corner = [-1, 4, 1]
edge_u = [2, 0, 0]
edge_v = [0, 0, -2]
[[lights]]
type = "point"
position = [0.9, 0.3, -0.9]
power = 10
[render]
passes = 2
[integrator.photons]
emitted = 10_000
)";

class VpmBake : public VpmBinary {
 protected:
  VpmBake() { write("scene.toml", kBakedScene); }
  void refuses(const std::string& mesh, const std::vector<std::string>& words,
               const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"bake", "scene.toml", "--mesh", mesh, "-o", "a.exr", "--resolution", "8"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    vpm_refuses(arguments, words);
  }
};

TEST_F(VpmBake, WritesIrradianceCoverageVarianceAndWhereItIsFrom) {
  vpm_succeeds({"bake", "scene.toml", "--mesh", "floor", "-o", "a.exr", "--resolution", "16"});
  EXPECT_EQ(files(), (std::vector<std::string>{"a.exr", "a.json", "a.png", "scene.toml"}));
  const ExrChannels exr = read_exr_channels(path("a.exr"));
  EXPECT_EQ(exr.width, 16);
  EXPECT_EQ(exr.height, 16);
  for (const char* channel : {"R", "variance.R", "coverage.R"}) EXPECT_EQ(exr.planes.count(channel), 1u) << channel;
  for (const float share : exr.planes.at("coverage.R")) EXPECT_NEAR(share, 1.0f, 1e-5f);
  EXPECT_EQ(exr.metadata.at("vpm.mesh"), "floor");
  EXPECT_EQ(exr.metadata.at("vpm.passes"), "2");
  EXPECT_NE(exr.metadata.at("vpm.quantity").find("irradiance"), std::string::npos);
  EXPECT_NE(exr.metadata.at("vpm.uncovered").find("0 of 256: black, but within 2 texels"), std::string::npos);
  // Under the light: at the end of u and of v, in the top right corner.
  const std::vector<float>& red = exr.planes.at("R");
  const auto brightest = std::max_element(red.begin(), red.end()) - red.begin();
  EXPECT_GE(brightest % 16, 14);
  EXPECT_LE(brightest / 16, 1);
  const nlohmann::json report = this->report("a.json");
  EXPECT_EQ(report["quantity"], "irradiance, W/m^2");
  EXPECT_EQ(report["texels"]["points"], 2 * 16 * 16);
  EXPECT_FALSE(report.contains("eye") || report.contains("error"));
  const std::vector<std::string> stages = report["stages"];
  EXPECT_NE(std::find(stages.begin(), stages.end(), "runs surface photon map"), stages.end());
  EXPECT_NE(std::find(stages.begin(), stages.end(), "skips volume photon map: no medium"), stages.end());
  EXPECT_EQ(report["width"], 16);
  EXPECT_EQ(report["light_map"]["covered_texels"], 256);
  EXPECT_NEAR(report["light_map"]["area_m2"].get<double>(), 4.0, 1e-5);
  const nlohmann::json& power = report["light_map"]["power_received_W"];
  EXPECT_GT(power["value"][0], 1.0);
  EXPECT_LT(power["value"][0], 10.0);
  EXPECT_GT(power["standard_error"][0], 0.0);
  vpm_succeeds({"bake", "scene.toml", "--mesh", "floor", "-o", "one.exr", "--resolution", "16", "--passes", "1"});
  EXPECT_TRUE(this->report("one.json")["light_map"]["power_received_W"]["standard_error"][0].is_null());
}

TEST_F(VpmBake, GivesTheSameBytesOnAnyNumberOfThreads) {
  const auto bake = [&](const std::string& output, const std::string& threads, const std::string& seed) {
    vpm_succeeds({"bake", "scene.toml", "--mesh", "floor", "-o", output, "--resolution", "40", "--threads", threads,
                  "--seed", seed, "--passes", "3", "--set", "integrator.direct.type=photons"});
    return read(output);
  };
  const std::string one = bake("one.exr", "1", "7");
  EXPECT_TRUE(one == bake("two.exr", "2", "7"));
  EXPECT_FALSE(one == bake("other.exr", "2", "8"));
}

TEST_F(VpmBake, LeavesThePictureOfTheSceneAlone) {
  vpm_succeeds({"render", "scene.toml", "--set", "film.width=8", "--set", "film.height=8"});
  const std::string picture = read("scene.exr"), report = read("scene.json");
  vpm_succeeds({"bake", "scene.toml", "--mesh", "floor", "--resolution", "8"});
  EXPECT_EQ(files(), (std::vector<std::string>{"scene.exr", "scene.floor.exr", "scene.floor.json", "scene.floor.png",
                                               "scene.json", "scene.png", "scene.toml"}));
  EXPECT_TRUE(read("scene.exr") == picture && read("scene.json") == report);
}

TEST_F(VpmBake, NeverReplacesAFileThatTheSceneIsReadFrom) {
  write_exr(path("tiles.exr"), Image(2, 2), {}, {});
  write("tiled.toml",
        std::string(kBakedScene) +
            "[[shapes]]\nname = 'tiled'\ntype = 'quad'\ncorner = [-1, 5, 1]\nedge_u = [2, 0, 0]\n"
            "edge_v = [0, 0, -2]\nmaterial = { type = 'mirror', reflectance = { texture = 'tiles.exr' } }\n");
  const std::string tiles = read("tiles.exr");
  vpm_refuses({"bake", "tiled.toml", "--mesh", "floor", "-o", "tiles.exr"}, {"tiles.exr", "the scene is read from"});
  EXPECT_TRUE(read("tiles.exr") == tiles);
}

TEST_F(VpmBake, TexelsThatNothingCoversAreTold) {
  write(
      "part.obj",
      "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nvt 0 0\nvt 0.5 0\nvt 0.5 0.5\nvt 0 0.5\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
  write("part.toml", std::string(kBakedScene) +
                         "[[shapes]]\nname = 'part'\ntype = 'mesh'\npath = 'part.obj'\nmaterial = 'white'\n"
                         "transform = [{ translate = [0, 0.01, 0] }]\n");
  vpm_succeeds({"bake", "part.toml", "--mesh", "part", "-o", "a.exr", "--resolution", "16"});
  const ExrChannels exr = read_exr_channels(path("a.exr"));
  EXPECT_NE(exr.metadata.at("vpm.uncovered").find("192 of 256"), std::string::npos);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const size_t texel = static_cast<size_t>(y) * 16 + x;
      EXPECT_EQ(exr.planes.at("coverage.G")[texel], x < 8 && y >= 8 ? 1.0f : 0.0f);
      const float green = exr.planes.at("G")[texel];
      if (x >= 10 || y < 6) {
        EXPECT_EQ(green, 0.0f);
      } else if (x > 7 && y < 8) {
        EXPECT_GT(green, 0.0f);  // beside the brightest corner
      }
    }
}

TEST_F(VpmBake, RefusesShapesThatNoLightMapCanBeOf) {
  refuses("flor", {"--mesh flor: there is no such shape", "did you mean 'floor'?", "ball", "crate"});
  refuses("ball", {"--mesh ball: it is no mesh"});
  refuses("crate", {"--mesh crate: it has no texture coordinates"});
  refuses("soot", {"--mesh soot: its material stores no photons", "not black"});
  refuses("glass", {"--mesh glass: its material stores no photons"});
}

TEST_F(VpmBake, RefusesCoordinatesThatAreNoMap) {
  const auto with_mesh = [&](const std::string& coordinates) {
    write("bad.obj", "v 0 0 0\nv 1 0 0\nv 1 0 -1\nv 0 0 -1\n" + coordinates + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
    write("scene.toml",
          std::string(kBakedScene) + "[[shapes]]\nname = 'bad'\ntype = 'mesh'\npath = 'bad.obj'\nmaterial = 'white'\n");
  };
  with_mesh("vt 0 0\nvt 2 0\nvt 2 1\nvt 0 1\n");
  refuses("bad", {"--mesh bad: a corner of triangle 0 has the texture coordinates (2, 0)", "[0, 1]"});
  with_mesh("vt 0 0\nvt 1 0\nvt 1 1\nvt 1 0\n");
  refuses("bad", {"--mesh bad: triangles 0 and 1 overlap in texture coordinates near ("});
}

TEST_F(VpmBake, RefusesManyOverlapsBeforeTheyFillTheMemory) {
  std::string mesh = "v 0 0 0\nv 1 0 0\nv 1 0 -1\nvt 0 0\nvt 1 0\nvt 1 1\n";
  for (int i = 0; i < 1000; ++i) mesh += "f 1/1 2/2 3/3\n";
  write("bad.obj", mesh);
  write("scene.toml",
        std::string(kBakedScene) + "[[shapes]]\nname = 'bad'\ntype = 'mesh'\npath = 'bad.obj'\nmaterial = 'white'\n");
  vpm_refuses({"bake", "scene.toml", "--mesh", "bad", "--resolution", "1024"},
              {"overlap in texture coordinates near ("}, kAddressSpace);
}

TEST_F(VpmBake, RefusesPhotonsThatDoNotFitIntoMemory) {
  refuses("floor",
          {"integrator.photons.emitted: the maps of a pass would hold", "integrator.photons.emitted would fit"},
          {"--set", "integrator.photons.emitted=1000000000000"});
}

TEST_F(VpmBake, TellsAfterHowManyPassesItWasInterrupted) {
  Process process(command({"bake", "scene.toml", "--mesh", "floor", "-o", "a.exr", "--resolution", "8", "--passes",
                           "100000", "--progress", "always"}),
                  {60.0, 0, folder_.string()});
  EXPECT_TRUE(process.wait_for_error_output(" left"));
  std::this_thread::sleep_for(std::chrono::seconds(1));
  process.signal(SIGINT);
  const ProcessResult result = process.wait();
  EXPECT_EQ(result.status, 130);
  const int passes = report("a.json")["passes"];
  EXPECT_NE(result.err.find("interrupted after " + std::to_string(passes) + " of 100000 passes"), std::string::npos)
      << result.err;
}

TEST_F(VpmBake, WhereNotOnePassFitsIntoTheTimeItSaysSo) {
  const ProcessResult result = vpm({"bake", "scene.toml", "--mesh", "floor", "-o", "a.exr", "--set",
                                    "render.seconds=0.3", "--set", "integrator.photons.emitted=50_000_000"});
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_NE(result.err.find("no pass is finished within the 0.3 s asked for"), std::string::npos) << result.err;
}

TEST_F(VpmBake, RefusesSettingsOfOtherIntegrators) {
  refuses("floor", {"'type' of [integrator] is \"path\"", "--set integrator.type=photon-map"},
          {"--set", "integrator.type=path"});
  refuses("floor", {"'radii' of [integrator] are \"per-pixel\"", "--set integrator.radii=per-pass"},
          {"--set", "integrator.radii=per-pixel"});
  refuses("floor", {"render.error", "--passes N"}, {"--set", "render.error=0.1"});
  vpm_refuses({"bake", "scene.toml", "--mesh", "floor", "-o", "a.png"}, {"must end in .exr"});
  refuses("floor", {"--resolution"}, {"--resolution", "0"});
  vpm_refuses({"bake", "scene.toml"}, {"--mesh is required"});
}

}  // namespace
}  // namespace vpm
