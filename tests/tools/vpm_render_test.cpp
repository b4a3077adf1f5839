// The program from outside: the same picture from the same seed, interruption, refusals before any work, what it prints
// and where.
#include <signal.h>
#include <sys/mount.h>

#include <cmath>
#include <cstring>
#include <tuple>

#include "image/exr.h"
#include "image/png.h"
#include "tools/vpm_binary.h"

namespace vpm {
namespace {

using Json = nlohmann::json;

/// A small plume over a floor, for several chunks of photons and several tiles of pixels a pass.
constexpr const char* kScene = R"(
[camera]
position = [0.0, 1.0, 2.5]
target = [0.0, 0.5, 0.0]
[film]
width = 40
height = 24
[media.smoke]
type = "grid"
path = "smoke.vdb"
sigma_t = 30
albedo = [0.9, 0.8, 0.7]
[materials.floor]
type = "lambertian"
reflectance = 0.5
[[shapes]]
type = "quad"
material = "floor"
corner = [-1, 0, 1]
edge_u = [2, 0, 0]
edge_v = [0, 0, -2]
[[lights]]
name = "lamp"
type = "spot"
position = [1, 2, 1]
target = [0, 0.5, 0]
outer_angle = 15
power = 10
[render]
passes = 2
[photons]
emitted = 10_000
[volume]
radius = 0.1
[surface]
radius = 0.1
)";

class VpmRender : public VpmBinary {
 protected:
  VpmRender() {
    write("scene.toml", kScene);
    vpm_succeeds({"media", "smoke", "--resolution", "16", "-o", "smoke.vdb"});
  }
};

/// A report without what may differ between two runs: times, memory in use, threads, the image's name.
Json without_circumstances(Json report) {
  for (const char* key : {"times", "threads", "image"}) report.erase(key);
  for (const char* key : {"emitted_per_second", "emitted_per_second_and_thread", "stored_per_second"})
    report["photons"].erase(key);
  report["memory"].erase("peak_of_process");
  return report;
}

bool same_pixels(const Image& a, const Image& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Rgb)) == 0;
}

double sum(const Image& image) {
  double total = 0.0;
  for (const Rgb& c : image.pixels) total += sum_channels(c);
  return total;
}

// --- The same seed

class VpmSameSeed : public VpmRender, public ::testing::WithParamInterface<std::tuple<const char*, const char*>> {};

TEST_P(VpmSameSeed, GivesTheSameBytesOnAnyNumberOfThreads) {
  const auto [gather, form] = GetParam();
  const auto render = [&](const std::string& name, const std::string& threads, const std::string& seed) {
    vpm_succeeds({"render", "scene.toml", "-o", name + ".exr", "--threads", threads, "--seed", seed, "--set",
                  "volume.gather=" + std::string(gather), "--set", "volume.form=" + std::string(form)});
  };
  render("one", "1", "7");
  render("two", "2", "7");
  render("again", "2", "7");
  render("other", "2", "8");
  EXPECT_TRUE(read("one.exr") == read("two.exr"));
  EXPECT_TRUE(read("two.exr") == read("again.exr"));
  EXPECT_EQ(without_circumstances(report("one.json")), without_circumstances(report("two.json")));
  EXPECT_EQ(without_circumstances(report("two.json")), without_circumstances(report("again.json")));
  const Image one = read_exr(path("one.exr"));
  EXPECT_GT(sum(one), 0.0);
  EXPECT_FALSE(same_pixels(one, read_exr(path("other.exr"))));
  EXPECT_GT(report("one.json")["photons"]["stored_volume"], 1000);
}

INSTANTIATE_TEST_SUITE_P(Gathers, VpmSameSeed,
                         ::testing::Combine(::testing::Values("radius", "nearest"),
                                            ::testing::Values("density-at-query", "density-at-photon")),
                         [](const auto& test) {
                           return std::get<0>(test.param) +
                                  std::string(std::get<1>(test.param) == std::string("density-at-query") ? "AtQuery"
                                                                                                         : "AtPhoton");
                         });

TEST_F(VpmRender, OptionsOverruleTheScene) {
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--passes", "3", "--seed", "5"});
  EXPECT_EQ(report("a.json")["passes"], 3);
  EXPECT_EQ(report("a.json")["seed"], 5);
  vpm_succeeds({"render", "scene.toml", "-o", "b.exr", "--set", "render.passes=3", "--set", "render.seed=5"});
  EXPECT_TRUE(same_pixels(read_exr(path("a.exr")), read_exr(path("b.exr"))));
  vpm_succeeds({"render", "scene.toml", "-o", "c.exr", "--time", "0.2"});
  EXPECT_GE(report("c.json")["times"]["total"], 0.2);
  EXPECT_EQ(report("c.json")["eye"]["camera_rays"], report("c.json")["passes"].get<int>() * 40 * 24);
}

TEST_F(VpmRender, TheImageIsNamedAfterTheSceneInTheCurrentFolder) {
  std::filesystem::create_directory(path("scenes"));
  write("scenes/plume.toml", kScene);
  vpm_succeeds({"render", "scenes/plume.toml", "--set", "media.smoke.path=smoke.vdb"});
  EXPECT_EQ(files(),
            (std::vector<std::string>{"plume.exr", "plume.json", "plume.png", "scene.toml", "scenes", "smoke.vdb"}));
}

TEST_F(VpmRender, TheImageTellsWhereItIsFrom) {
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr"});
  const ExrChannels exr = read_exr_channels(path("a.exr"));
  for (const char* channel : {"R", "G", "B", "variance.R", "variance.G", "variance.B"})
    EXPECT_EQ(exr.planes.count(channel), 1u) << channel;
  EXPECT_EQ(exr.metadata.at("vpm.passes"), "2");
  EXPECT_EQ(exr.metadata.at("vpm.seed"), "1");
  EXPECT_EQ(exr.metadata.at("vpm.sceneHash"), report("a.json")["scene_hash"]);
}

TEST_F(VpmRender, TheReportNamesEveryLightAndItsPower) {
  write("two.toml", std::string(kScene) +
                        "[[lights]]\ntype = 'environment'\nradiance = [1, 2, 3]\n"
                        "[[shapes]]\nname = 'plate'\ntype = 'disc'\nmaterial = 'floor'\ncenter = [0, 3, 0]\n"
                        "normal = [0, -1, 0]\nradius = 0.5\nemission = 2\n");
  vpm_succeeds({"render", "two.toml", "-o", "a.exr"});
  const Json all = report("a.json")["lights"];
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0]["name"], "lamp");
  EXPECT_EQ(all[0]["kind"], "spot");
  EXPECT_NEAR(all[0]["power_W"][0].get<double>(), 10.0, 1e-5);
  EXPECT_EQ(all[1]["name"], "");
  EXPECT_EQ(all[1]["number"], 1);
  EXPECT_EQ(all[1]["kind"], "constant environment");
  // pi L times the surface of the box around floor, smoke and plate, 2 m x 3 m x 2 m.
  EXPECT_NEAR(all[1]["power_W"][2].get<double>(), 3.0 * M_PI * 32.0, 0.01);
  EXPECT_EQ(all[2]["name"], "plate");
  EXPECT_EQ(all[2]["kind"], "disc");
  EXPECT_NEAR(all[2]["power_W"][1].get<double>(), 2.0 * M_PI * M_PI * 0.25, 1e-5);
  double total = 0.0, share = 0.0;
  for (const Json& light : all) {
    total += light["power_W"][1].get<double>();  // green, the mean of the channels here
    share += light["share"].get<double>();
  }
  EXPECT_NEAR(share, 1.0, 1e-6);
  EXPECT_NEAR(all[0]["share"].get<double>(), 10.0 / total, 1e-6);
}

TEST_F(VpmRender, TheReportDividesTheMapsByAllPhotonsInThem) {
  write("glass.toml", std::string(kScene) +
                          "[[shapes]]\ntype = 'sphere'\ncenter = [0.5, 1.25, 0.5]\nradius = 0.2\n"
                          "material = { type = 'dielectric', ior = 1.5 }\n");
  vpm_succeeds({"render", "glass.toml", "-o", "a.exr", "--set", "surface.indirect=final-gather", "--set",
                "surface.gather_by=photons", "--set", "surface.irradiance=precomputed"});
  const Json photons = report("a.json")["photons"], memory = report("a.json")["memory"];
  double of_a_pass = 0.0;
  for (const char* map :
       {"stored_volume", "stored_surface", "stored_caustic", "stored_to_guide_gathering", "irradiance_points"}) {
    EXPECT_GT(photons[map], 0) << map;
    of_a_pass += photons[map].get<double>() / 2.0;
  }
  EXPECT_NEAR(memory["per_stored_photon_of_mean_pass"].get<double>() * of_a_pass,
              memory["largest_photon_maps"].get<double>(), 1.0);
}

TEST_F(VpmRender, TheReportCountsTheMemoryOfTextures) {
  std::filesystem::copy_file(std::string(VPM_SOURCE_DIR) + "/tests/input/textures/checker.png", path("checker.png"));
  write("tiled.toml",
        std::string(kScene) + "[materials.tiles]\ntype = 'mirror'\nreflectance = { texture = 'checker.png' }\n");
  vpm_succeeds({"render", "tiled.toml", "-o", "a.exr"});
  const uint64_t texels = static_cast<uint64_t>(read_png(path("checker.png"), PngValues::srgb).pixels.size());
  EXPECT_EQ(report("a.json")["memory"]["textures"], texels * 3 * sizeof(float));
}

TEST_F(VpmRender, TheReportCountsTheMemoryOfSkies) {
  vpm_succeeds({"render", "scene.toml", "-o", "sky.exr"});
  write("under_sky.toml", std::string(kScene) + "[[lights]]\ntype = 'environment'\npath = 'sky.exr'\n");
  vpm_succeeds({"render", "under_sky.toml", "-o", "a.exr"});
  constexpr uint64_t kTexels = 40 * 24;
  EXPECT_EQ(report("a.json")["memory"]["lights"], kTexels * (3 * sizeof(float) + sizeof(double)) + sizeof(double));
}

// --- Interruption

/// Starts a render, sends it the signal when `sign` is in its error output, and waits for its end.
ProcessResult interrupt(Process& process, int signal, const std::string& sign) {
  EXPECT_TRUE(process.wait_for_error_output(sign));
  process.signal(signal);
  return process.wait();
}

TEST_F(VpmRender, AnInterruptedRenderKeepsItsFinishedPasses) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Process process(command({"render", "scene.toml", "-o", "a.exr", "--time", "50", "--progress", "always"}),
                    {60.0, 0, folder_.string()});
    // Of a render by time the time left is told once a pass is finished.
    const ProcessResult result = interrupt(process, signal, " left");
    EXPECT_EQ(result.status, 130) << result.err;
    const int passes = report("a.json")["passes"];
    EXPECT_GE(passes, 1);
    EXPECT_EQ(read_exr_channels(path("a.exr")).metadata.at("vpm.passes"), std::to_string(passes));
    vpm_succeeds({"render", "scene.toml", "-o", "whole.exr", "--passes", std::to_string(passes)});
    EXPECT_TRUE(read("a.exr") == read("whole.exr"));
    EXPECT_EQ(files(), (std::vector<std::string>{"a.exr", "a.json", "a.png", "scene.toml", "smoke.vdb", "whole.exr",
                                                 "whole.json", "whole.png"}));
  }
}

TEST_F(VpmRender, ARenderInterruptedInItsFirstPassLeavesNothing) {
  const std::vector<std::string> before = files();
  for (const char* slow : {"render.samples_per_pixel=64", "photons.emitted=4_000_000_000"}) {
    Process process(command({"render", "scene.toml", "-o", "a.exr", "--set", slow, "--set", "film.width=1024", "--set",
                             "film.height=1024", "--progress", "always"}),
                    {20.0, 0, folder_.string()});
    const ProcessResult result = interrupt(process, SIGINT, "render  [");
    EXPECT_EQ(result.status, 130) << result.err;
    EXPECT_NE(result.err.find("nothing is written"), std::string::npos) << result.err;
    EXPECT_EQ(files(), before);
  }
}

// --- Checkpoints

TEST_F(VpmRender, KilledAtAnyMomentItResumesToTheSameBits) {
  const std::vector<std::string> passes{"--passes", "40", "--set", "photons.emitted=3_000"};
  const auto render = [&](const std::string& name, const std::string& option) {
    std::vector<std::string> arguments{"render", "scene.toml", "-o", name, option};
    arguments.insert(arguments.end(), passes.begin(), passes.end());
    return arguments;
  };
  const double whole = vpm_succeeds(render("whole.exr", "--checkpoint")).seconds;
  int resumed = 0;
  for (int kill = 0; kill < 10; ++kill) {
    const bool begun = std::filesystem::exists(path("a.checkpoint"));
    resumed += begun;
    Process process(command(render("a.exr", begun ? "--resume" : "--checkpoint")), {60.0, 0, folder_.string()});
    std::this_thread::sleep_for(std::chrono::duration<double>(whole * (0.2 + 0.37 * kill - std::floor(0.37 * kill))));
    process.signal(SIGKILL);
    process.wait();
  }
  EXPECT_GT(resumed, 0);
  vpm_succeeds(render("a.exr", "--resume"));
  EXPECT_TRUE(read("a.exr") == read("whole.exr"));
  EXPECT_EQ(without_circumstances(report("a.json")), without_circumstances(report("whole.json")));
}

TEST_F(VpmRender, ACheckpointTakesMorePassesButNoOtherScene) {
  vpm_succeeds({"render", "scene.toml", "-o", "whole.exr", "--passes", "5"});
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--passes", "2", "--checkpoint"});
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--passes", "5", "--resume"});
  EXPECT_TRUE(read("a.exr") == read("whole.exr"));
  vpm_refuses({"render", "scene.toml", "-o", "a.exr", "--resume", "--seed", "9"}, {"another render", "seed 9"});
  vpm_refuses({"render", "scene.toml", "-o", "a.exr", "--resume", "--set", "film.width=20"}, {"another render"});
  vpm_refuses({"render", "scene.toml", "-o", "b.exr", "--resume"}, {"b.checkpoint", "there is no such file"});
  vpm_succeeds({"media", "smoke", "--resolution", "17", "-o", "smoke.vdb"});  // other bytes under the same name
  vpm_refuses({"render", "scene.toml", "-o", "a.exr", "--resume"}, {"another render"});
}

TEST_F(VpmRender, RadiiOfPixelsResumeToTheSameBits) {
  const auto render = [&](const std::string& name, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"render", "scene.toml", "-o", name, "--set", "render.radii=per-pixel"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    vpm_succeeds(arguments);
  };
  render("whole.exr", {"--passes", "9", "--threads", "1"});
  render("a.exr", {"--passes", "2", "--checkpoint"});
  render("a.exr", {"--passes", "5", "--resume"});
  render("a.exr", {"--passes", "9", "--resume"});
  EXPECT_TRUE(read("a.exr") == read("whole.exr"));
  EXPECT_EQ(without_circumstances(report("a.json")), without_circumstances(report("whole.json")));
  const Json a = report("a.json"), radii = a["radii_of_pixels"];
  EXPECT_LT(radii["smallest"], 0.08);
  EXPECT_LT(radii["smallest"], radii["mean"]);
  EXPECT_LT(radii["mean"], radii["largest"]);
  EXPECT_LE(radii["largest"], 0.1f);
  EXPECT_EQ(a["memory"]["radii_of_pixels"], 40 * 24 * 16);
  EXPECT_EQ(a["error"]["bias_not_seen_of"], Json::array({"surface"}));
  vpm_succeeds({"render", "scene.toml", "-o", "b.exr"});
  EXPECT_TRUE(report("b.json")["radii_of_pixels"].is_null());
  vpm_refuses({"render", "scene.toml", "-o", "a.exr", "--resume"}, {"another render", "radii=per-pass"});
}

TEST_F(VpmRender, StopsAtAnError) {
  for (const char* error : {"0", "-1", "nan"}) vpm_refuses({"render", "scene.toml", "--error", error}, {"--error"});
  vpm_refuses({"render", "scene.toml", "--error", "0.1", "--passes", "3"}, {"--error"});
  const ProcessResult coarse = vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--error", "0.2"});
  vpm_succeeds({"render", "scene.toml", "-o", "b.exr", "--error", "0.02"});
  const Json a = report("a.json"), b = report("b.json");
  EXPECT_LE(a["error"]["estimated"], 0.2);
  EXPECT_LE(b["error"]["estimated"], 0.02);
  EXPECT_GT(b["passes"], a["passes"]);
  EXPECT_NE(coarse.out.find("estimated relative MSE"), std::string::npos) << coarse.out;
}

TEST_F(VpmRender, LogsErrorsAgainstAReference) {
  vpm_succeeds({"render", "scene.toml", "-o", "truth.exr", "--passes", "12"});
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--passes", "12", "--reference", "truth.exr"});
  const auto rows_of = [&](const std::string& file) {
    std::istringstream csv(read(file));
    std::string line;
    std::getline(csv, line);
    EXPECT_EQ(line, "passes,seconds,mse,relative_mse,mean_ratio");
    std::vector<std::vector<double>> rows;
    while (std::getline(csv, line)) {
      std::vector<double>& row = rows.emplace_back();
      std::istringstream cells(line);
      for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    }
    return rows;
  };
  const auto rows = rows_of("a.errors.csv");
  ASSERT_EQ(rows.size(), 12u);  // a tenth of 11 is more than one, but the last has a line
  EXPECT_EQ(rows[0][0], 1.0);
  EXPECT_GT(rows[0][3], 0.0);
  // The same picture: nothing is left but the reference's own noise, subtracted.
  EXPECT_EQ(rows[11][0], 12.0);
  EXPECT_LT(rows[11][3], 0.0);
  EXPECT_EQ(rows[11][4], 1.0);
  // A render that goes on keeps what it had told.
  const std::vector<std::string> begin{"render", "scene.toml", "-o", "c.exr", "--reference", "truth.exr"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = begin;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  vpm_succeeds(with({"--passes", "5", "--checkpoint"}));
  vpm_succeeds(with({"--passes", "12", "--resume"}));
  const auto resumed = rows_of("c.errors.csv");
  ASSERT_EQ(resumed.size(), rows.size());
  for (size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(resumed[i][3], rows[i][3]);
  vpm_refuses({"render", "scene.toml", "-o", "b.exr", "--set", "film.width=41", "--reference", "truth.exr"},
              {"truth.exr: the reference has 40 x 24 pixels, but the render 41 x 24"});
  vpm_refuses({"render", "scene.toml", "-o", "truth.exr", "--reference", "truth.exr"}, {"it is the reference"});
  vpm_refuses({"render", "scene.toml", "-o", "b.exr", "--reference", "none.exr"}, {"none.exr"});
}

// --- Refusals

TEST_F(VpmRender, OutputsThatCannotBeWrittenAreRefusedBeforeRendering) {
  std::filesystem::create_directory(path("folder.exr"));
  std::filesystem::create_directory(path("taken.json"));
  // So long a render that the time limit tells whether it began.
  const auto refused = [&](const std::string& output, const std::string& word) {
    vpm_refuses({"render", "scene.toml", "--passes", "1000000000", "-o", output}, {word});
  };
  refused("missing/a.exr", "there is no folder");
  refused("folder.exr", "it is a folder");
  refused("taken.exr", "it is a folder");
  refused("a.png", ".exr");
  refused("a", ".exr");
  refused("/dev/full", ".exr");
  refused("/proc/a.exr", "cannot write");
}

TEST_F(VpmRender, NeverReplacesAFileThatTheSceneIsReadFrom) {
  std::filesystem::copy_file(std::string(VPM_SOURCE_DIR) + "/scenes/tiles.png", path("tiles.png"));
  std::filesystem::create_symlink("scene.toml", path("link.json"));
  write("tiled.toml",
        std::string(kScene) + "[materials.tiles]\ntype = 'mirror'\nreflectance = { texture = 'tiles.png' }\n");
  const std::string tiles = read("tiles.png");
  vpm_refuses({"render", "tiled.toml", "-o", "tiles.exr"}, {"tiles.png", "the scene is read from"});
  vpm_refuses({"render", "scene.toml", "-o", "link.exr"}, {"link.json", "the scene is read from 'scene.toml'"});
  EXPECT_TRUE(read("tiles.png") == tiles);
  EXPECT_EQ(read("scene.toml"), kScene);
}

TEST_F(VpmRender, NotesAreToldBeforeTheWork) {
  write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 2\n");
  write("flat.toml", std::string(kScene) + "[[shapes]]\ntype = 'mesh'\nmaterial = 'floor'\npath = 'flat.obj'\n");
  const std::string text = vpm_succeeds({"render", "flat.toml", "-o", "a.exr", "--progress", "always"}).err;
  EXPECT_LT(text.find("note: shape 'shape 1': 1 triangles without area dropped"), text.find("render  ["));
}

/// A file system of a few pages, while it lives.
class TinyDisk {
 public:
  explicit TinyDisk(const std::string& folder) : folder_(folder) {
    std::filesystem::create_directory(folder);
    mounted_ = mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=256k") == 0;
  }
  ~TinyDisk() {
    if (mounted_) umount2(folder_.c_str(), MNT_DETACH);
  }
  TinyDisk(const TinyDisk&) = delete;
  TinyDisk& operator=(const TinyDisk&) = delete;
  bool mounted() const { return mounted_; }

 private:
  std::string folder_;
  bool mounted_ = false;
};

TEST_F(VpmRender, AFullDiskIsRefusedBeforeRendering) {
  const TinyDisk disk(path("disk"));
  if (!disk.mounted()) GTEST_SKIP() << "only root outside of containers can make a small disk";
  vpm_refuses({"render", "scene.toml", "--passes", "1000000000", "--set", "film.width=400", "--set", "film.height=400",
               "-o", "disk/a.exr"},
              {"MiB free"});
  EXPECT_TRUE(std::filesystem::is_empty(path("disk")));
}

TEST_F(VpmRender, BadCommandLinesAreRefused) {
  vpm_refuses({"render", "missing.toml"}, {"missing.toml"});
  vpm_refuses({"render", "scene.toml", "--set", "render.passes"}, {"render.passes", "="});
  vpm_refuses({"render", "scene.toml", "--set", "render.pases=2"}, {"pases"});
  vpm_refuses({"render", "scene.toml", "--set", "render.passes=0"}, {"passes"});
  vpm_refuses({"render", "scene.toml", "--set", "media.smoke.path=missing.vdb"}, {"missing.vdb"});
  vpm_refuses({"render", "scene.toml", "--passes", "0"}, {"--passes"});
  vpm_refuses({"render", "scene.toml", "--passes", "2.5"}, {"--passes"});
  vpm_refuses({"render", "scene.toml", "--passes", "2", "--time", "1"}, {"--time"});
  for (const char* seconds : {"0", "-1", "nan", "inf"})
    vpm_refuses({"render", "scene.toml", "--time", seconds}, {"--time"});
  for (const char* seed : {"-1", "1.5", "x", "18446744073709551616"})
    vpm_refuses({"render", "scene.toml", "--seed", seed}, {"--seed"});
  vpm_refuses({"render", "scene.toml", "--threads", "-1"}, {"--threads"});
  vpm_refuses({"render", "scene.toml", "--threads", "5000"}, {"--threads"});
  vpm_refuses({"render", "scene.toml", "--progress", "perhaps"}, {"--progress"});
  vpm_refuses({"render", "scene.toml", "--bogus"}, {"--bogus"});
  vpm_refuses({"render"}, {"scene"});
  vpm_refuses({"paint", "scene.toml"}, {"subcommand"});
  vpm_refuses({}, {"subcommand"});
}

TEST_F(VpmRender, ErrorsInScenesTellTheirPlace) {
  std::string scene = kScene;
  scene.replace(scene.find("sigma_t = 30"), 12, "sigma_t = -3");
  write("bad.toml", scene);
  vpm_refuses({"render", "bad.toml"}, {"bad.toml:11:", "sigma_t = -3", "^"});
}

// --- What it prints

TEST_F(VpmRender, ProgressIsSilentUnlessATerminalWatchesOrItIsAskedFor) {
  const auto errors = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"render", "scene.toml", "-o", "a.exr"});
    return vpm_succeeds(options).err;
  };
  EXPECT_EQ(errors({}), "");
  EXPECT_EQ(errors({"--progress", "auto"}), "");
  EXPECT_EQ(errors({"--progress", "never"}), "");
  EXPECT_NE(errors({"--progress", "always"}).find("100 %"), std::string::npos);
}

TEST_F(VpmRender, SaysWhereTheOutputsAre) {
  const std::string out = vpm_succeeds({"render", "scene.toml", "-o", "a.exr"}).out;
  for (const char* word : {"a.exr", "a.png", "a.json", "2 passes"}) EXPECT_NE(out.find(word), std::string::npos) << out;
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << "expected: " << word << "\n" << text;
}

TEST_F(VpmRender, InfoTellsWhatFilesHold) {
  expect_words(vpm_succeeds({"info", "scene.toml"}).out,
               {"40 x 24 pixels", "medium smoke: grid", "sigma_t 30 1/m", "mean free path", "around everything: vacuum",
                "light 0, lamp: spot, power 10 W", "runs volume photon map", "runs surface photon map",
                "skips shadow rays in media", "coefficients differ between channels"});
  expect_words(vpm_succeeds({"info", "scene.toml", "--set", "media.smoke.albedo=0.5", "--set",
                             "volume.direct=shadow-rays", "--set", "transmittance.estimator=jackknife"})
                   .out,
               {"all coefficients are grey", "runs shadow rays in media, transmittance by jackknife (biased; "});
  expect_words(vpm_succeeds({"info", "smoke.vdb"}).out,
               {"grid density", "type float, class fog volume", "voxel size", "active voxels", "world box", "mean",
                "background 0", "memory"});
  vpm_refuses({"info", "missing.vdb"}, {"missing.vdb"});
  vpm_refuses({"info", "missing.toml"}, {"missing.toml"});
  vpm_refuses({"info", "smoke.bin"}, {"smoke.bin"});
  vpm_refuses({"info"}, {"file"});
}

TEST_F(VpmBinary, TellsItsVersionAndItsGrids) {
  expect_words(vpm_succeeds({"--version"}).out, {"vpm 0."});
  expect_words(vpm_succeeds({"--help"}).out, {"render", "info", "error", "media"});
  expect_words(vpm_succeeds({"media"}).out, {"smoke", "cloud", "constant", "ramp", "gaussian"});
}

TEST_F(VpmBinary, MakesTheSameGridEachTime) {
  vpm_succeeds({"media", "cloud", "--resolution", "12", "-o", "a.vdb"});
  vpm_succeeds({"media", "cloud", "--resolution", "12", "-o", "b.vdb"});
  EXPECT_TRUE(read("a.vdb") == read("b.vdb"));
  vpm_succeeds({"media", "ramp", "--resolution", "4"});
  EXPECT_EQ(files(), (std::vector<std::string>{"a.vdb", "b.vdb", "ramp.vdb"}));
  vpm_refuses({"media", "nothing"}, {"nothing", "cloud"});
  vpm_refuses({"media", "cloud", "--resolution", "1"}, {"resolution"});
  vpm_refuses({"media", "cloud", "--resolution", "4", "-o", "missing/a.vdb"}, {"there is no folder"});
}

TEST_F(VpmBinary, MakesMeshes) {
  expect_words(vpm_succeeds({"mesh"}).out, {"ring", "waves"});
  vpm_succeeds({"mesh", "waves", "--resolution", "12", "-o", "a.ply"});
  vpm_succeeds({"mesh", "ring"});
  EXPECT_EQ(files(), (std::vector<std::string>{"a.ply", "ring.ply"}));
  vpm_refuses({"mesh", "nothing"}, {"nothing", "waves"});
  vpm_refuses({"mesh", "ring", "--resolution", "2"}, {"resolution"});
  vpm_refuses({"mesh", "ring", "-o", "missing/a.ply"}, {"there is no folder"});
}

}  // namespace
}  // namespace vpm
