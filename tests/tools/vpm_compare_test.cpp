// Comparisons from outside: what the folder holds, that finished runs are kept, and what a known ratio comes out as.
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "tools/ball_of_fog.h"
#include "tools/vpm_binary.h"
#include "vpm/image/exr.h"

namespace vpm {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kBallOfFog = ball_of_fog(6, 4);

/// One ray for each pixel against four: in passes the second is four times as efficient, whatever the scene.
constexpr const char* kKnownRatio = R"(
title = "One ray against four"
unit = "passes"
budgets = [16, 64]
repetitions = 8
[reference]
error = 1e-4
[set]
integrator.type = "path"
[product]
render.samples_per_pixel = [1, 4]
[[scenes]]
name = "ball of fog"
file = "fog.toml"
)";

/// One method of two keeps what its techniques find.
constexpr const char* kWithLayers = R"(
title = "Layers"
unit = "passes"
budgets = [1, 3]
repetitions = 3
[reference]
error = 1
[[methods]]
name = "combined"
[methods.set]
integrator.type = "combined"
integrator.layers = true
[[methods]]
name = "photon maps"
[[scenes]]
name = "ball of fog"
file = "fog.toml"
)";

class VpmCompare : public VpmBinary {
 protected:
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  json results(const std::string& folder) { return json::parse(std::ifstream(folder_ / folder / "results.json")); }
  /// When each finished run was written.
  std::map<fs::path, fs::file_time_type> runs(const std::string& folder) {
    std::map<fs::path, fs::file_time_type> found;
    for (const auto& entry : fs::directory_iterator(folder_ / folder / "runs"))
      if (entry.path().extension() == ".json") found[entry.path()] = fs::last_write_time(entry);
    return found;
  }
};

TEST_F(VpmCompare, RecoversARatioKnownByConstruction) {
  write("fog.toml", kBallOfFog);
  write("known.toml", kKnownRatio);
  const ProcessResult result = vpm_succeeds({"compare", "known.toml", "-o", "out"});
  EXPECT_NE(result.out.find("4 is "), std::string::npos) << result.out;
  const json scene = results("out").at("scenes").at(0);
  for (const json& budget : scene.at("methods").at(0).at("budgets")) {
    const json& efficiency = budget.at("efficiency");
    EXPECT_LE(efficiency.at("lo"), 0.25);
    EXPECT_GE(efficiency.at("hi"), 0.25);
  }
  EXPECT_EQ(scene.at("best"), json::array({1, 1}));
  const json& pair = scene.at("pairs").at(0);
  EXPECT_LE(pair.at("lo"), 0.25);
  EXPECT_GE(pair.at("hi"), 0.25);
  EXPECT_LT(pair.at("p_holm"), 0.01);
  for (const json& method : scene.at("methods")) {
    EXPECT_LE(method.at("slope").at("lo"), -1.0);
    EXPECT_GE(method.at("slope").at("hi"), -1.0);
    const json& last = method.at("budgets").at(1);
    EXPECT_LE(last.at("bias").at("lo"), 0.0);
    EXPECT_GE(last.at("bias").at("hi"), 0.0);
    EXPECT_EQ(last.at("runs").at(7).at("passes"), 64);
  }
}

TEST_F(VpmCompare, GoesOnWhereItWasInterruptedAndRepeatsNothing) {
  write("fog.toml", kBallOfFog);
  write("two.toml", R"(
title = "Two radii"
unit = "photons"
budgets = [4000, 8000]
repetitions = 3
[reference]
error = 1e-2
[product]
integrator.volume.radius = [0.2, 0.4]
[[scenes]]
name = "ball of fog"
file = "fog.toml"
)");
  vpm_succeeds({"compare", "two.toml", "-o", "out"});
  const auto first = runs("out");
  ASSERT_EQ(first.size(), 6u);
  const json before = results("out");
  fs::remove(first.begin()->first);
  vpm_succeeds({"compare", "two.toml", "-o", "out"});
  const auto second = runs("out");
  ASSERT_EQ(second.size(), 6u);
  size_t kept = 0;
  for (const auto& [path, time] : first) kept += second.at(path) == time;
  EXPECT_EQ(kept, 5u);
  const auto errors = [](const json& all) {
    std::vector<double> found;
    for (const json& method : all.at("scenes").at(0).at("methods"))
      for (const json& budget : method.at("budgets"))
        for (const json& run : budget.at("runs")) found.push_back(run.at("relative_mse"));
    return found;
  };
  EXPECT_EQ(errors(results("out")), errors(before));
  std::ifstream csv(folder_ / "out/results.csv");
  size_t lines = 0;
  for (std::string line; std::getline(csv, line);) ++lines;
  EXPECT_EQ(lines, 1u + 2u * 2u * 3u);
}

/// Of a picture with what techniques find in it: the sum of these, in green, over the picture.
double parts_over_whole(const ExrChannels& picture) {
  const auto sum_of = [&](const std::string& channel) {
    const std::vector<float>& plane = picture.planes.at(channel);
    return std::accumulate(plane.begin(), plane.end(), 0.0);
  };
  double parts = 0.0;
  for (const auto& [name, plane] : picture.planes)
    if (name.ends_with(".weighted.G")) parts += sum_of(name);
  return parts / sum_of("G");
}

TEST_F(VpmCompare, KeepsWhatTechniquesFind) {
  write("fog.toml", kBallOfFog);
  write("layers.toml", kWithLayers);
  const auto techniques = [&](size_t method) {
    return results("out").at("scenes").at(0).at("methods").at(method).at("techniques");
  };
  vpm_succeeds({"compare", "layers.toml", "-o", "out"});
  const json found = techniques(0);
  ASSERT_EQ(found.size(), 6u);
  double shares = 0.0;
  for (const json& technique : found) {
    shares += technique.at("share_of_light").get<double>();
    EXPECT_EQ(technique.at("variance") > 0.0, technique.at("share_of_light") > 0.0) << technique;
  }
  EXPECT_NEAR(shares, 1.0, 1e-12);
  EXPECT_TRUE(techniques(1).empty());
  // One picture of all runs and budgets has its parts with it; its run is found again with them, or made again.
  fs::path first;
  for (const auto& entry : fs::directory_iterator(folder_ / "out/runs"))
    if (entry.path().extension() == ".exr" && read_exr_channels(entry.path()).planes.size() > 4) {
      EXPECT_TRUE(first.empty());
      first = entry.path();
    }
  ASSERT_TRUE(first.string().ends_with(".1.exr")) << first;
  EXPECT_NEAR(parts_over_whole(read_exr_channels(first)), 1.0, 1e-6);
  const fs::path run = fs::path(first).replace_extension().replace_extension(".json");
  const auto before = runs("out");
  for (const auto& [path, time] : before)
    if (path != run) fs::remove(path);
  vpm_succeeds({"compare", "layers.toml", "-o", "out"});
  EXPECT_EQ(runs("out").at(run), before.at(run));
  EXPECT_EQ(techniques(0), found);
  fs::remove(run);
  vpm_succeeds({"compare", "layers.toml", "-o", "out"});
  EXPECT_EQ(techniques(0), found);
  // The second repetition, which has no such pictures, becomes the first.
  vpm_succeeds({"compare", "layers.toml", "-o", "out", "--set", "seed=2"});
  EXPECT_EQ(techniques(0).size(), 6u);
}

TEST_F(VpmCompare, TakesExactPicturesForReferences) {
  const std::string even_light =
      kBallOfFog.substr(0, kBallOfFog.find("[[lights]]")) + "[[lights]]\ntype = \"environment\"\n";
  write("fog.toml", even_light +
                        "radiance = 2\n"
                        "[integrator.photons]\nemitted = 2000\n");
  write("exact.toml", R"(
title = "Paths against the exact solution"
unit = "passes"
budgets = [16]
repetitions = 8
[product]
integrator.type = ["path", "photon-map"]
[[scenes]]
name = "ball of fog"
file = "fog.toml"
reference = "exact"
)");
  vpm_succeeds({"compare", "exact.toml", "-o", "out"});
  const json scene = results("out").at("scenes").at(0);
  EXPECT_EQ(scene.at("reference").at("source"), "the exact solution");
  // Right paths miss it with 5 % of all seeds; the seed is fixed.
  const json& bias = scene.at("methods").at(0).at("budgets").at(0).at("bias");
  EXPECT_LE(bias.at("lo"), 0.0);
  EXPECT_GE(bias.at("hi"), 0.0);
  EXPECT_LT(bias.at("hi").get<double>() - bias.at("lo").get<double>(), 0.04);
  const json& queries = scene.at("methods").at(1).at("budgets").at(0).at("runs").at(0);
  EXPECT_GT(queries.at("photons_visited"), queries.at("photons_used"));
  EXPECT_GT(queries.at("photons_used"), 0);
}

TEST_F(VpmCompare, BiasesBesideReferencesInDoubtAreNotJudged) {
  write("fog.toml", kBallOfFog);
  vpm_succeeds({"render", "fog.toml", "-o", "photons.exr", "--passes", "2"});
  vpm_succeeds({"render", "fog.toml", "-o", "paths.exr", "--passes", "2", "--set", "integrator.type=path"});
  vpm_succeeds({"render", "fog.toml", "-o", "one.exr", "--passes", "1", "--set", "integrator.type=path"});
  const auto why = [&](const std::string& more) {
    write("e.toml", "title = \"t\"\nunit = \"passes\"\nbudgets = [1]\nrepetitions = 3\n" + more +
                        "[product]\nintegrator.volume.radius = [0.2, 0.4]\n");
    const ProcessResult result = vpm_succeeds({"compare", "e.toml", "-o", "out"});
    const json verdict = results("out").at("scenes").at(0).at("methods").at(0).at("verdict");
    EXPECT_EQ(verdict.at("p").is_null(), verdict.at("says") == "not determined");
    EXPECT_NE(result.out.find(verdict.at("why").get<std::string>()), std::string::npos) << result.out;
    return verdict.at("why").get<std::string>();
  };
  const std::string scene = "[[scenes]]\nname = \"fog\"\nfile = \"fog.toml\"\n";
  const std::string of_photons = "the reference is of photons and may be biased itself";
  EXPECT_EQ(why("[reference]\nerror = 1\n" + scene), "");
  const std::string photon_maps = "[reference]\nerror = 1\nset.integrator.type = \"photon-map\"\n";
  for (int i = 0; i < 2; ++i) EXPECT_EQ(why(photon_maps + scene), of_photons);  // made, then found
  EXPECT_EQ(why("baseline = \"0.4\"\n" + photon_maps + scene), "");
  EXPECT_EQ(why(scene + "reference = \"paths.exr\"\n"), "");
  EXPECT_EQ(why(scene + "reference = \"photons.exr\"\n"), of_photons);
  EXPECT_EQ(why(scene + "reference = \"one.exr\"\n"), "the reference has no variance");
}

TEST_F(VpmCompare, RefusesBeforeItRenders) {
  write("fog.toml", kBallOfFog);
  const std::string head = "title = \"t\"\nbudgets = [1]\n[[scenes]]\nname = \"fog\"\nfile = \"fog.toml\"\n";
  write("unknown.toml", head + "[product]\nintegrator.volume.radios = [1, 2]\n");
  vpm_refuses({"compare", "unknown.toml", "-o", "out"},
              {"unknown.toml:6:", "method '1' on scene 'fog'", "--set integrator.volume.radios=1", "unknown key"});
  write("methods.toml", head + "[[methods]]\nname = \"a\"\n[[methods]]\nname = \"b\"\nset.volume.beams = \"long\"\n");
  vpm_refuses({"compare", "methods.toml", "-o", "out"}, {"methods.toml:8:1: method 'b' on scene 'fog': "});
  write("sizes.toml", head + "[product]\nfilm.width = [6, 7]\n");
  vpm_refuses({"compare", "sizes.toml", "-o", "out"}, {"sizes.toml:3:1: ", "6 x 4", "7 x 4"});
  write("exact.toml", head + "reference = \"exact\"\n[product]\nrender.seed = [1, 2]\n");
  vpm_refuses({"compare", "exact.toml", "-o", "out"},
              {"exact.toml:3:1: ", "scene 'fog'", "no exact picture", "its light is no"});
  vpm_refuses({"compare", "none.toml", "-o", "out"}, {"none.toml"});
}

}  // namespace
}  // namespace vpm
