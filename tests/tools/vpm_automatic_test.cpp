// Settings that vpm render chooses: told with their reasons, and the same picture when they are given.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tools/plume.h"
#include "vpm/image/exr.h"
#include "vpm/integrators/describe.h"

namespace vpm {
namespace {

class VpmAutomatic : public VpmRender {
 protected:
  /// The plume without what can be chosen.
  VpmAutomatic() {
    const std::string scene = kScene;
    write("open.toml", scene.substr(0, scene.find("[integrator.photons]")));
  }
  /// The options that a run's last note gives.
  static std::vector<std::string> told(const std::string& errors) {
    const std::string sign = "without choosing: ";
    std::istringstream words(errors.substr(errors.find(sign) + sign.size()));
    return {std::istream_iterator<std::string>(words), {}};
  }
};

TEST_F(VpmAutomatic, WhatItTellsRendersTheSamePicture) {
  const std::string chosen_notes = vpm_succeeds({"render", "open.toml", "--auto", "-o", "auto.exr"}).err;
  for (const char* key : {"integrator.photons.emitted", "integrator.volume.radius", "integrator.surface.radius"})
    EXPECT_NE(chosen_notes.find(std::string("note: chosen ") + key), std::string::npos) << chosen_notes;
  std::vector<std::string> again{"render", "open.toml", "-o", "again.exr"};
  for (const std::string& word : told(chosen_notes)) again.push_back(word);
  ASSERT_EQ(again.size(), 4u + 6u) << chosen_notes;
  vpm_succeeds(again);
  EXPECT_TRUE(read_exr(path("auto.exr")).pixels == read_exr(path("again.exr")).pixels);
  EXPECT_EQ(report("auto.json")["settings"], report("again.json")["settings"]);
  EXPECT_EQ(report("auto.json")["notes"].size(), 5u);
  EXPECT_EQ(report("again.json")["notes"].size(), 0u);
  const std::string line = read_exr_channels(path("auto.exr")).metadata.at("vpm.settings");
  EXPECT_EQ(line, read_exr_channels(path("again.exr")).metadata.at("vpm.settings"));
  const nlohmann::json settings = report("auto.json")["settings"];
  EXPECT_EQ(field_of(line, "integrator.photons.emitted"), settings["integrator.photons.emitted"].dump());
}

/// With a time all is chosen that the scene leaves open; without one its integrator stays.
TEST_F(VpmAutomatic, TheIntegratorIsChosenByTime) {
  const std::string errors = vpm_succeeds({"render", "open.toml", "--auto", "--time", "1", "-o", "auto.exr"}).err;
  expect_words(errors, {"chosen integrator.type = ", "photon-map", "combined", "path"});
  EXPECT_NE(told(errors).at(1).find("integrator.type="), std::string::npos);
  std::vector<std::string> again{"render", "open.toml", "-o", "again.exr", "--passes", "1"};
  for (const std::string& word : told(errors)) again.push_back(word);
  vpm_succeeds(again);
  EXPECT_EQ(report("auto.json")["settings"]["integrator.type"], report("again.json")["settings"]["integrator.type"]);
  const std::string without = vpm_succeeds({"render", "scene.toml", "--auto", "-o", "given.exr"}).err;
  EXPECT_EQ(without.find("chosen integrator.type"), std::string::npos) << without;
}

TEST_F(VpmAutomatic, WhatIsGivenIsRenderedAsEver) {
  const std::vector<std::string> given{"--set", "integrator.distance.type=delta-local", "--set",
                                       "integrator.type=photon-map"};
  vpm_succeeds({"render", "scene.toml", "-o", "given.exr"});
  std::vector<std::string> automatic{"render", "scene.toml", "-o", "auto.exr", "--auto"};
  automatic.insert(automatic.end(), given.begin(), given.end());
  vpm_succeeds(automatic);
  EXPECT_TRUE(read_exr(path("given.exr")).pixels == read_exr(path("auto.exr")).pixels);
  EXPECT_EQ(report("given.json")["settings"], report("auto.json")["settings"]);
}

TEST_F(VpmAutomatic, AWordInTheFileAsksForOneChoice) {
  const std::string errors =
      vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--set", "integrator.volume.radius=auto"}).err;
  EXPECT_EQ(told(errors).size(), 2u) << errors;
  EXPECT_EQ(told(errors).back().find("integrator.volume.radius="), 0u);
}

TEST_F(VpmAutomatic, TheGatherInMediaIsChosenWhereItIsAskedFor) {
  const auto line_of = [](const std::string& errors) {
    const size_t at = errors.find("chosen integrator.volume.type = ");
    return at == std::string::npos ? "" : errors.substr(at, errors.find('\n', at) - at);
  };
  const std::string chosen = line_of(
      vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--time", "1", "--set", "integrator.volume.type=auto"}).err);
  expect_words(chosen, {"pilot passes", "photon-map by "});
  const std::string photons = "integrator.type=photon-map";
  EXPECT_EQ(line_of(vpm_succeeds({"render", "open.toml", "--auto", "--set", photons, "-o", "b.exr"}).err), "");
  EXPECT_EQ(report("b.json")["settings"]["integrator.volume.type"], "radius");
}

TEST_F(VpmAutomatic, AResumedRenderKeepsItsChoices) {
  vpm_succeeds({"render", "open.toml", "--auto", "-o", "a.exr", "--checkpoint", "--passes", "2"});
  const std::string errors =
      vpm_succeeds({"render", "open.toml", "--auto", "-o", "a.exr", "--resume", "--passes", "4"}).err;
  EXPECT_NE(errors.find("as chosen when the render began"), std::string::npos) << errors;
  std::vector<std::string> whole{"render", "open.toml", "-o", "whole.exr", "--passes", "4"};
  for (const std::string& word : told(errors)) whole.push_back(word);
  vpm_succeeds(whole);
  EXPECT_TRUE(read_exr(path("a.exr")).pixels == read_exr(path("whole.exr")).pixels);
  vpm_refuses({"render", "open.toml", "-o", "a.exr", "--resume"}, {"it is of another render"});
  vpm_succeeds({"render", "open.toml", "-o", "a.exr", "--checkpoint", "--overwrite"});
  vpm_refuses({"render", "open.toml", "--auto", "-o", "a.exr", "--resume"},
              {"it is of another render", "left to be chosen: nothing in the checkpoint, "});
}

TEST_F(VpmAutomatic, OtherCommandsRefuseToChoose) {
  vpm_refuses({"bake", "scene.toml", "--mesh", "shape 0", "--set", "integrator.surface.radius=auto"},
              {"vpm bake chooses no settings", "name a value of integrator.surface.radius"});
  write("two.toml", R"(
title = "Two radii"
unit = "passes"
budgets = [1]
repetitions = 3
[reference]
error = 1e-2
[product]
integrator.volume.radius = ["auto", 0.2]
[[scenes]]
name = "plume"
file = "scene.toml"
)");
  const auto result = vpm({"compare", "two.toml", "-o", "out"});
  EXPECT_EQ(result.status, 2);
  expect_words(result.err, {"settings are chosen for a time, but budgets are in passes",
                            "name a value of integrator.volume.radius", "unit = \"seconds\""});
}

/// A pilot is part of a run's time, and what it chose stands with the run.
TEST_F(VpmAutomatic, ComparedMethodsMayChoose) {
  write("chosen.toml", R"(
title = "Chosen and given"
budgets = [0.2]
repetitions = 3
[reference]
error = 1e-2
[[scenes]]
name = "plume"
file = "scene.toml"
[[methods]]
name = "chosen"
set = { integrator.type = "auto" }
[[methods]]
name = "given"
)");
  vpm_succeeds({"compare", "chosen.toml", "-o", "out"});
  const nlohmann::json results = nlohmann::json::parse(read("out/results.json"));
  const nlohmann::json& methods = results.at("scenes").at(0).at("methods");
  expect_words(methods.at(0).at("settings").get<std::string>(), {"; chosen: integrator.type="});
  EXPECT_EQ(methods.at(1).at("settings").get<std::string>().find("chosen"), std::string::npos);
}

}  // namespace
}  // namespace vpm
