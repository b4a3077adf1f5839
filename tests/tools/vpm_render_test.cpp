// The program from outside: the same picture from the same seed, refusals before any work, what it prints and where.
#include <sys/mount.h>

#include <cmath>
#include <cstring>
#include <tuple>

#include "tools/plume.h"
#include "vpm/image/exr.h"
#include "vpm/image/png.h"

namespace vpm {
namespace {

using Json = nlohmann::json;

// --- The same seed

class VpmSameSeed : public VpmRender, public ::testing::WithParamInterface<std::tuple<const char*, const char*>> {};

TEST_P(VpmSameSeed, GivesTheSameBytesOnAnyNumberOfThreads) {
  const auto [gather, form] = GetParam();
  const auto render = [&](const std::string& name, const std::string& threads, const std::string& seed) {
    vpm_succeeds({"render", "scene.toml", "-o", name + ".exr", "--threads", threads, "--seed", seed, "--set",
                  "integrator.volume.type=" + std::string(gather), "--set",
                  "integrator.volume.form=" + std::string(form)});
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
  vpm_succeeds({"render", "scene.toml", "-o", "c.exr", "--time", "1"});
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
  EXPECT_EQ(exr.metadata.at("vpm.sceneHash"), report("a.json")["scene_hash"].get<std::string>());
}

TEST_F(VpmRender, WritesTheLayersThatAreAskedFor) {
  vpm_succeeds({"render", "--layers", "samples,depth", "scene.toml", "-o", "a.exr"});
  const ExrChannels by_option = read_exr_channels(path("a.exr"));
  EXPECT_EQ(by_option.planes.at("samples.X")[0], 2.0f);
  EXPECT_EQ(by_option.planes.count("depth.Z"), 1u);
  EXPECT_EQ(by_option.planes.count("normal.X"), 0u);
  vpm_succeeds({"render", "scene.toml", "-o", "b.exr", "--set", "render.layers=[\"depth\", \"samples\"]"});
  const ExrChannels by_setting = read_exr_channels(path("b.exr"));
  EXPECT_EQ(by_setting.planes, by_option.planes);
  EXPECT_NE(by_setting.metadata.at("vpm.settings").find("render.layers=depth+samples"), std::string::npos);
  vpm_succeeds({"render", "scene.toml", "-o", "c.exr", "--layers", "combined,normal", "--set",
                "integrator.type=combined", "--set", "integrator.photons.emitted=100"});
  const ExrChannels both = read_exr_channels(path("c.exr"));
  EXPECT_EQ(both.planes.count("normal-variance.Z"), 1u);
  EXPECT_EQ(both.planes.count("combined.connections.weighted.variance.R"), 1u);
}

TEST_F(VpmRender, RefusesLayersThatThereAreNot) {
  vpm_refuses(
      {"render", "scene.toml", "--layers", "depth,normals"},
      {"normals", "combined", "depth", "normal", "albedo", "transmittance", "single-scattering-albedo", "samples"});
  vpm_refuses({"render", "scene.toml", "--layers", "depth,depth"}, {"'depth' twice"});
  vpm_refuses({"render", "scene.toml", "--set", "render.layers=[\"deep\"]"}, {"layers", "'deep'", "depth"});
  vpm_refuses({"render", "scene.toml", "--layers", "combined"}, {"combined", "integrator"});
  vpm_refuses({"bake", "scene.toml", "--mesh", "floor", "--set", "render.layers=[\"depth\"]"},
              {"render.layers", "light map"});
}

TEST_F(VpmRender, GoesOnWithItsLayers) {
  const std::vector<std::string> layers{"--layers", "depth,albedo,single-scattering-albedo"};
  const auto render = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"render", "scene.toml"});
    options.insert(options.end(), layers.begin(), layers.end());
    vpm_succeeds(options);
  };
  render({"-o", "a.exr"});
  render({"-o", "b.exr", "--passes", "1", "--checkpoint"});
  render({"-o", "b.exr", "--passes", "2", "--resume"});
  EXPECT_EQ(read_exr_channels(path("b.exr")).planes, read_exr_channels(path("a.exr")).planes);
  vpm_refuses({"render", "scene.toml", "-o", "b.exr", "--resume", "--layers", "depth"},
              {"render.layers: depth+albedo"});
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

TEST_F(VpmRender, TheReportDividesTheMapsByAllRecordsInThem) {
  write("glass.toml", std::string(kScene) +
                          "[[shapes]]\ntype = 'sphere'\ncenter = [0.5, 1.25, 0.5]\nradius = 0.2\n"
                          "material = { type = 'dielectric', ior = 1.5 }\n");
  vpm_succeeds({"render", "glass.toml", "-o", "a.exr", "--set", "integrator.indirect.type=final-gather", "--set",
                "integrator.indirect.rays_by=photons", "--set", "integrator.indirect.irradiance=precomputed", "--set",
                "integrator.volume.type=photon-planes"});
  const Json photons = report("a.json")["photons"], memory = report("a.json")["memory"];
  double of_a_pass = 0.0;
  for (const char* map : {"stored_volume", "stored_surface", "stored_caustic", "stored_to_guide_gathering",
                          "irradiance_points", "stored_beams", "stored_planes"}) {
    EXPECT_GT(photons[map], 0) << map;
    of_a_pass += photons[map].get<double>() / 2.0;
  }
  EXPECT_NEAR(memory["per_stored_record_of_mean_pass"].get<double>() * of_a_pass,
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

TEST_F(VpmRender, NamesOfFilesNeedNotBeUtf8) {
  const std::string name = "\xe9t\xe9";  // in Latin-1
  std::filesystem::create_directory(path(name));
  const auto in = [&](const char* extension) { return name + "/" + name + extension; };
  vpm_succeeds({"media", "smoke", "--resolution", "16", "-o", in(".vdb")});
  vpm_succeeds({"mesh", "ring", "--resolution", "8", "-o", in(".ply")});
  std::filesystem::copy_file(std::string(VPM_SOURCE_DIR) + "/tests/input/textures/checker.png", path(in("0.png")));
  write(in(".toml"), std::string(kScene) +
                         "[materials.tiles]\ntype = 'mirror'\nreflectance = { texture = '' }\n[[shapes]]\n"
                         "type = 'mesh'\npath = ''\nmaterial = 'tiles'\n[[lights]]\ntype = 'environment'\npath = ''\n");
  vpm_succeeds({"render", "scene.toml", "-o", in("1.exr"), "--seed", "5"});
  const std::vector<std::string> render{"render",      in(".toml"),
                                        "-o",          in(".exr"),
                                        "--reference", in("1.exr"),
                                        "--set",       "media.smoke.path=" + in(".vdb"),
                                        "--set",       "shapes.1.path=" + in(".ply"),
                                        "--set",       "materials.tiles.reflectance.texture=" + in("0.png"),
                                        "--set",       "lights.1.path=" + in("1.exr"),
                                        "--passes"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = render;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  vpm_succeeds(with({"1", "--checkpoint"}));
  vpm_succeeds(with({"2", "--resume"}));
  // What is no UTF-8 stands in JSON as U+FFFD, in the picture as it is.
  EXPECT_EQ(report(in(".json"))["image"], "\ufffdt\ufffd/\ufffdt\ufffd.exr");
  EXPECT_EQ(read_exr_channels(path(in(".exr"))).metadata.at("vpm.scene"), name + ".toml");
  for (const char* extension : {".png", ".checkpoint", ".errors.csv"})
    EXPECT_TRUE(std::filesystem::exists(path(in(extension)))) << extension;
  vpm_succeeds({"bake", in(".toml"), "--mesh", "ground", "-o", in("2.exr"), "--resolution", "4", "--set",
                "media.smoke.path=" + in(".vdb"), "--set", "shapes.1.path=" + in(".ply"), "--set",
                "materials.tiles.reflectance.texture=" + in("0.png"), "--set", "lights.1.path=" + in("1.exr"), "--set",
                "shapes.0.name=ground"});
  vpm_succeeds({"info", in(".vdb")});
  vpm_succeeds({"error", in(".exr"), in("1.exr"), "-o", in("3.exr")});
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

TEST_F(VpmRender, FilesThatMayNotBecomeSoLargeAreRefused) {
  write("a.exr", "kept");
  Process process({"/bin/sh", "-c", "ulimit -f 4; exec " VPM_BINARY " render scene.toml --passes 1 -o a.exr"},
                  {60.0, 0, folder_.string()});  // 2 KiB
  const ProcessResult result = process.wait();
  EXPECT_EQ(result.status, 2);
  expect_words(result.err, {"a.exr", "File too large"});
  EXPECT_EQ(read("a.exr"), "kept");
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
  vpm_refuses({"render", "scene.toml", "--set", "integrator.photons.emitted=1_000_000_000_000_000"},
              {"integrator.photons.emitted", "memory"});
  for (const char* seconds : {"0", "-1", "nan", "inf"})
    vpm_refuses({"render", "scene.toml", "--time", seconds}, {"--time"});
  for (const char* seed : {"-1", "1.5", "x", "18446744073709551616"})
    vpm_refuses({"render", "scene.toml", "--seed", seed}, {"--seed"});
  vpm_refuses({"render", "scene.toml", "--threads", "-1"}, {"--threads"});
  vpm_refuses({"render", "scene.toml", "--threads", "5000"}, {"--threads"});
  vpm_refuses({"render", "scene.toml", "--progress", "perhaps"}, {"--progress"});
  vpm_refuses({"render", "scene.toml", "--bogus"}, {"vpm: render: there is no option '--bogus'\n", "vpm help render"});
  vpm_refuses({"render", "scene.toml", "--pases", "3"}, {"there is no option '--pases'; did you mean '--passes'?"});
  vpm_refuses({"render", "scene.toml", "one", "two"}, {"vpm: render: 'one' is one argument too many"});
  vpm_refuses({"--threads", "4", "render", "scene.toml"}, {"'--threads' stands before the command"});
  vpm_refuses({"render"}, {"vpm: render: scene is required"});
  vpm_refuses({"paint", "scene.toml"}, {"vpm: there is no command 'paint'; vpm help"});
  vpm_refuses({"rendr", "scene.toml"}, {"did you mean 'render'?"});
  vpm_refuses({"help", "nothing"}, {"there is no command 'nothing'"});
  vpm_refuses({}, {"SUBCOMMAND"});
}

TEST_F(VpmRender, ErrorsInScenesTellTheirPlace) {
  std::string scene = kScene;
  scene.replace(scene.find("sigma_t = 30"), 12, "sigma_t = -3");
  write("bad.toml", scene);
  vpm_refuses({"render", "bad.toml"}, {"bad.toml:11:", "sigma_t = -3", "^"});
}

TEST_F(VpmBinary, TellsItsVersionAndItsGrids) {
  expect_words(vpm_succeeds({"--version"}).out, {"vpm 0."});
  for (const char* ask : {"--help", "help"})
    expect_words(vpm_succeeds({ask}).out, {"render", "info", "error", "media", "Example: vpm render"});
  expect_words(vpm_succeeds({"help", "render"}).out, {"--passes", "--checkpoint", "--overwrite"});
  vpm_refuses({}, {"Example: vpm render"});
  for (const char* command : {"render", "view", "merge", "tonemap", "bake", "compare", "info", "error", "report",
                              "media", "mesh", "validate", "exact"})
    expect_words(vpm_succeeds({"help", command}).out, {std::string("Example: vpm ") + command + " "});
  expect_words(vpm_succeeds({"exact", "slab", "--help"}).out, {"tau        optical thickness [required]"});
  vpm_refuses({"render", "smoke.vdb"}, {"smoke.vdb: this is a grid", ".toml", "vpm info smoke.vdb"});
  expect_words(vpm_succeeds({"media"}).out,
               {"smoke      0.7 x 1 x 0.7 m", "cloud      1000 x 600 x 800 m", "constant", "ramp", "gaussian"});
}

TEST_F(VpmBinary, FailsWhereItsOutputCannotBeWritten) {
  for (const char* arguments : {" media", " --version", " help"}) {
    Process process({"/bin/sh", "-c", VPM_BINARY + (arguments + std::string(" > /dev/full"))},
                    {20.0, 0, folder_.string()});
    const ProcessResult result = process.wait();
    EXPECT_EQ(result.status, 1) << arguments;
    expect_words(result.err, {"standard output", "No space left"});
  }
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
  expect_words(vpm_succeeds({"mesh"}).out, {"ring", "pole", "waves"});
  vpm_succeeds({"mesh", "waves", "--resolution", "12", "-o", "a.ply"});
  vpm_succeeds({"mesh", "ring"});
  EXPECT_EQ(files(), (std::vector<std::string>{"a.ply", "ring.ply"}));
  vpm_refuses({"mesh", "nothing"}, {"nothing", "waves"});
  vpm_refuses({"mesh", "ring", "--resolution", "2"}, {"resolution"});
  vpm_refuses({"mesh", "ring", "-o", "missing/a.ply"}, {"there is no folder"});
}

}  // namespace
}  // namespace vpm
