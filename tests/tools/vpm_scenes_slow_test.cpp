// Every scene of the project renders, small, and its energy ledger closes; every experiment can be loaded.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "tools/vpm_binary.h"
#include "vpm/image/exr.h"
#include "vpm/input/scene_file.h"
#include "vpm/study/compare/exact_picture.h"
#include "vpm/study/compare/experiment.h"

namespace vpm {
namespace {

using Json = nlohmann::json;

/// Where a grid or mesh of a scene comes from: one of our generators, or a real file.
struct FileSource {
  std::string scene, key, command, name;  // `vpm command name`; no command: the file of that name
};
const std::vector<FileSource> kFiles{{"smoke", "media.smoke.path", "media", "smoke"},
                                     {"plume_room", "media.smoke.path", "media", "smoke"},
                                     {"plume_lake", "media.smoke.path", "media", "smoke"},
                                     {"plume_lake", "shapes.water.path", "mesh", "waves"},
                                     {"cloud", "media.cloud.path", "media", "cloud"},
                                     {"fire", "media.fire.path", "media", "fire"},
                                     {"fire_glass", "media.fire.path", "media", "fire"},
                                     {"ring_caustic", "shapes.ring.path", "mesh", "ring"},
                                     {"pool", "shapes.water.path", "mesh", "waves"},
                                     {"street_lamp", "shapes.pole.path", "mesh", "pole"},
                                     {"smoke1", "media.smoke.path", "", "smoke1.vdb"},
                                     {"wdas_cloud", "media.cloud.path", "", "wdas_cloud_sixteenth.vdb"},
                                     {"usd_smoke", "media.smoke.path", "", "usd_smoke3.vdb"}};

std::string scene_folder() { return std::string(VPM_SOURCE_DIR) + "/scenes/"; }

/// The names of all scenes, without folder and extension.
std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(scene_folder()))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class VpmScenes : public VpmBinary {
 protected:
  /// The options that give the scene its grid and meshes, --set and a value by turns; none where it has none. Nothing
  /// at all where a real grid is missing.
  std::optional<std::vector<std::string>> file_options(const std::string& scene) const {
    std::vector<std::string> options;
    for (const FileSource& source : kFiles) {
      if (source.scene != scene) continue;
      std::string file = std::string(VPM_SHARED_DIR) + "/vdb/" + source.name;
      if (!source.command.empty()) {
        file = path(source.command == "mesh" ? "made.ply" : "made.vdb");
        vpm_succeeds({source.command, source.name, "--resolution", "48", "-o", file});
      } else if (!std::filesystem::exists(file)) {
        return std::nullopt;
      }
      options.insert(options.end(), {"--set", source.key + "=" + file});
    }
    return options;
  }

  /// The options that give the scene one small grid for each of its own, and its meshes.
  std::vector<std::string> stand_ins(const std::string& scene) const {
    std::vector<std::string> options;
    for (const FileSource& source : kFiles) {
      if (source.scene != scene) continue;
      const bool mesh = source.command == "mesh";
      const std::string name = source.command.empty() ? "smoke" : source.name;
      const std::string file = path(name + (mesh ? ".ply" : ".vdb"));
      if (!std::filesystem::exists(file))
        vpm_succeeds({mesh ? "mesh" : "media", name, "--resolution", "12", "-o", file});
      options.insert(options.end(), {"--set", source.key + "=" + file});
    }
    return options;
  }

  /// The values of such options.
  static std::vector<std::string> overrides(const std::vector<std::string>& options) {
    std::vector<std::string> values;
    for (size_t i = 1; i < options.size(); i += 2) values.push_back(options[i]);
    return values;
  }

  /// Renders a scene of the project, small, and returns its report. Nothing is to be told.
  Json render(const std::string& scene, const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{"render",   scene_folder() + scene + ".toml",
                                       "-o",       path("a.exr"),
                                       "--passes", "2",
                                       "--set",    "film.width=64",
                                       "--set",    "film.height=48",
                                       "--set",    "integrator.photons.emitted=100_000"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(vpm_succeeds(arguments).err, "");
    return report("a.json");
  }
};

/// Absorbed, escaped and cut energy equal the emitted: false-alarm rate 6e-7 where the effective sample size is large.
void expect_closed_ledger(const Json& report) {
  const Json& energy = report["energy"];
  for (size_t c = 0; c < 3; ++c) {
    const auto flow = [&](const char* name) { return energy[name][c].get<double>(); };
    const double emitted = flow("emitted"), error = energy["imbalance"]["standard_error"][c];
    const double lost = (flow("absorbed_in_media") + flow("absorbed_on_surfaces") + flow("escaped") +
                         flow("cut_at_max_events") - emitted) /
                        emitted;
    EXPECT_GT(emitted, 0.0);
    EXPECT_LT(error, 0.01);
    EXPECT_LT(std::abs(lost), 5.0 * error + 1e-5) << energy.dump(2);  // powers are floats
    EXPECT_NEAR(energy["imbalance"]["value"][c].get<double>(), lost, 1e-6);
  }
  EXPECT_EQ(report["photons"]["paths_cut_at_max_events"], 0);
  EXPECT_EQ(report["photons"]["dropped_non_finite"], 0);
  EXPECT_EQ(report["eye"]["dropped_non_finite"], 0);
  // Rays through the very edges of boundaries: some in 1e7.
  EXPECT_LE(report["boundaries"]["met_in_another_medium"].get<double>(),
            2.0 + 1e-6 * report["boundaries"]["crossings"].get<double>());
}

class VpmEveryScene : public VpmScenes, public ::testing::WithParamInterface<std::string> {};

TEST_P(VpmEveryScene, RendersAndItsEnergyLedgerCloses) {
  const auto made = file_options(GetParam());
  if (!made) GTEST_SKIP() << "the grid of this scene is not here";
  const Json report = render(GetParam(), *made);
  expect_closed_ledger(report);

  // What was emitted is what the lights have; which light a photon comes from is chance, so channels vary by at most
  // 5/sqrt(2e5) = 1.1 %.
  const Scene scene = load_scene(scene_folder() + GetParam() + ".toml", overrides(*made)).scene;
  Rgbd power(0.0);
  for (const Light& light : scene.lights) power += Rgbd(light_power(light, scene.bounds));
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(report["energy"]["emitted"][c].get<double>(), power[c], 0.011 * power[c]) << "channel " << c;

  const Image image = read_exr(path("a.exr"));
  int lit = 0;
  for (const Rgb& c : image.pixels) {
    EXPECT_TRUE(is_finite(c) && c.r >= 0.0f && c.g >= 0.0f && c.b >= 0.0f);
    lit += !is_black(c);
  }
  EXPECT_GT(lit, GetParam() == "fire" ? 64 * 48 / 3 : 64 * 48 / 2);  // beside the fire's floor there is nothing
}

INSTANTIATE_TEST_SUITE_P(Scenes, VpmEveryScene, ::testing::ValuesIn(scene_names()),
                         [](const auto& test) { return test.param; });

// Every key and value of the experiments is one that its scenes know, whatever their grids hold.
TEST_F(VpmScenes, OfAllExperimentsCanBeLoaded) {
  size_t loaded = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scene_folder() + "experiments")) {
    if (entry.path().extension() != ".toml") continue;
    const ComparisonPlan plan = load_comparison_plan(entry.path().string());
    for (const ComparedScene& scene : plan.scenes) {
      std::vector<std::string> of_scene = scene.settings;
      for (const std::string& value : overrides(stand_ins(std::filesystem::path(scene.file).stem().string())))
        of_scene.push_back(value);
      const auto load = [&](std::vector<std::string> settings) {
        settings.insert(settings.begin(), of_scene.begin(), of_scene.end());
        EXPECT_NO_THROW(load_scene(scene.file, settings)) << entry.path() << ", " << scene.name;
        ++loaded;
      };
      if (scene.source == ReferenceSource::exact) {
        EXPECT_NO_THROW(exact_picture(load_scene(scene.file, of_scene).scene)) << entry.path() << ", " << scene.name;
      }
      load(scene.rendered.settings);
      for (const Method& method : plan.methods) load(method.settings);
    }
  }
  EXPECT_GT(loaded, 30u);
}

TEST_F(VpmScenes, TheHomogeneousStrategyRefusesGrids) {
  std::vector<std::string> arguments{"render", scene_folder() + "smoke.toml", "--set",
                                     "integrator.distance.type=homogeneous"};
  const auto grid = *file_options("smoke");
  arguments.insert(arguments.end(), grid.begin(), grid.end());
  vpm_refuses(arguments, {"homogeneous", "grid"});
}

}  // namespace
}  // namespace vpm
