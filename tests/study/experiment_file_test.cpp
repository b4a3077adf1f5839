// Experiment files: every key arrives where it belongs, products are whole, and mistakes are refused with their place.
#include "vpm/study/compare/experiment.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "input/expectations.h"
#include "support/test_file.h"

namespace vpm {
namespace {

std::string write_experiment(const std::string& text) {
  std::ofstream(test_file("fog.toml")) << "";
  std::ofstream(test_file("truth.exr")) << "";
  const std::string path = test_file("experiment.toml");
  std::ofstream(path) << text;
  return path;
}
ComparisonPlan load(const std::string& text) { return load_comparison_plan(write_experiment(text)); }
std::string message(const std::string& text) {
  return message_of([&] { load(text); });
}

const std::string kHead = "title = \"t\"\nbudgets = [1, 2]\n";
const std::string kScene = "[[scenes]]\nname = \"fog\"\nfile = \"fog.toml\"\n";
const std::string kMethods = "[[methods]]\nname = \"a\"\n[[methods]]\nname = \"b\"\n[methods.set]\nrender.seed = 3\n";

TEST(ExperimentFile, ReadsEveryKey) {
  const std::string text =
      "title = \"Fog\"\nunit = \"photons\"\nbudgets = [10, 1e3]\nrepetitions = 5\nseed = 9\n"
      "[reference]\nerror = 1e-3\n"
      "[set]\nintegrator.volume.radius = 0.25\n" +
      kScene + "reference = \"truth.exr\"\n[scenes.set]\nfilm.width = 8\ncamera.position = [0, 1.5, 2]\n" +
      "[[scenes]]\nname = \"mist\"\nfile = \"fog.toml\"\n" + kMethods;
  const ComparisonPlan plan = load(text);
  EXPECT_EQ(plan.title, "Fog");
  EXPECT_EQ(plan.text, text);
  EXPECT_EQ(plan.unit, CostUnit::photons);
  EXPECT_EQ(plan.budgets, (std::vector<double>{10.0, 1000.0}));
  EXPECT_EQ(plan.repetitions, 5);
  EXPECT_EQ(plan.seed, 9u);
  ASSERT_EQ(plan.scenes.size(), 2u);
  EXPECT_EQ(plan.scenes[1].rendered.error, static_cast<double>(1e-3f));
  EXPECT_EQ(plan.scenes[1].rendered.settings, std::vector<std::string>{"integrator.type=\"path\""});
  EXPECT_EQ(plan.scenes[1].source, ReferenceSource::rendered);
  EXPECT_EQ(plan.scenes[0].name, "fog");
  EXPECT_TRUE(plan.scenes[0].file.ends_with("/fog.toml"));
  EXPECT_EQ(plan.scenes[0].source, ReferenceSource::file);
  EXPECT_TRUE(plan.scenes[0].reference_file.ends_with("/truth.exr"));
  EXPECT_EQ(plan.scenes[0].settings, (std::vector<std::string>{"film.width=8", "camera.position=[0, 1.5, 2]"}));
  ASSERT_EQ(plan.methods.size(), 2u);
  EXPECT_EQ(plan.methods[0].name, "a");
  EXPECT_EQ(plan.methods[0].settings, (std::vector<std::string>{"integrator.volume.radius=0.25"}));
  EXPECT_EQ(plan.methods[1].settings, (std::vector<std::string>{"integrator.volume.radius=0.25", "render.seed=3"}));
}

TEST(ExperimentFile, ReferencesMayBeExact) {
  const ComparisonPlan plan = load(kHead + kScene + "reference = \"exact\"\n" + kMethods);
  EXPECT_EQ(plan.scenes[0].source, ReferenceSource::exact);
  EXPECT_EQ(load(kHead + kScene + kMethods).scenes[0].source, ReferenceSource::rendered);
}

TEST(ExperimentFile, MakesEveryCombinationOfAProduct) {
  const ComparisonPlan plan = load(kHead +
                                   "[product]\nintegrator.distance.type = [\"regular\", "
                                   "\"ray-march\"]\nintegrator.volume.radius = [0.1, 0.2, 0.4]\n" +
                                   kScene + "[[methods]]\nname = \"path\"\nset = { integrator.type = \"path\" }\n");
  std::vector<std::string> names;
  for (const Method& method : plan.methods) names.push_back(method.name);
  EXPECT_EQ(names, (std::vector<std::string>{"regular 0.1", "regular 0.2", "regular 0.4", "ray-march 0.1",
                                             "ray-march 0.2", "ray-march 0.4", "path"}));
  EXPECT_EQ(plan.methods[4].settings,
            (std::vector<std::string>{"integrator.distance.type=\"ray-march\"", "integrator.volume.radius=0.2"}));
  EXPECT_EQ(plan.unit, CostUnit::seconds);
  EXPECT_EQ(plan.repetitions, 10);
}

TEST(ExperimentFile, TheProjectsOwnAreRight) {
  int found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(VPM_SOURCE_DIR "/scenes/experiments")) {
    if (entry.path().extension() != ".toml") continue;
    const ComparisonPlan plan = load_comparison_plan(entry.path().string());
    EXPECT_GE(plan.methods.size(), 2u) << entry.path();
    for (const ComparedScene& scene : plan.scenes) EXPECT_TRUE(std::filesystem::exists(scene.file)) << scene.file;
    ++found;
  }
  EXPECT_GE(found, 5);
}

TEST(ExperimentFile, ReferencesMayBeMadeOfPhotons) {
  const ComparisonPlan plan = load(kHead + "[reference.set]\nintegrator.photons.emitted = 7\n" + kScene + kMethods);
  EXPECT_EQ(plan.scenes[0].rendered.settings, std::vector<std::string>{"integrator.photons.emitted=7"});
}

TEST(ExperimentFile, ScenesMaySayHowTheirReferencesAreRendered) {
  const std::string other = "[[scenes]]\nname = \"mist\"\nfile = \"fog.toml\"\n";
  const ComparisonPlan plan = load(kHead + "[reference]\nerror = 0.5\nset = { integrator.photons.emitted = 7 }\n" +
                                   kScene + "reference = { error = 0.25 }\n" + other +
                                   "[scenes.reference.set]\nintegrator.photons.emitted = 8\n" + kMethods);
  EXPECT_EQ(plan.scenes[0].source, ReferenceSource::rendered);
  EXPECT_EQ(plan.scenes[0].rendered.error, 0.25);
  EXPECT_EQ(plan.scenes[0].rendered.settings, std::vector<std::string>{"integrator.photons.emitted=7"});
  EXPECT_EQ(plan.scenes[1].rendered.error, 0.5);
  EXPECT_EQ(plan.scenes[1].rendered.settings, std::vector<std::string>{"integrator.photons.emitted=8"});
}

TEST(ExperimentFile, OptionsChangeKeys) {
  const std::string path = write_experiment(kHead + kScene + "[scenes.set]\nfilm.width = 8\n" + kMethods);
  const ComparisonPlan plan =
      load_comparison_plan(path, {"repetitions=4", "scenes.fog.set.film.width=16", "budgets=[3]"});
  EXPECT_EQ(plan.repetitions, 4);
  EXPECT_EQ(plan.budgets, std::vector<double>{3.0});
  EXPECT_EQ(plan.scenes[0].settings, std::vector<std::string>{"film.width=16"});
  EXPECT_NE(message_of([&] { load_comparison_plan(path, {"repetitions=none"}); }).find("--set repetitions=none"),
            std::string::npos);
}

TEST(ExperimentFile, RefusesWhatIsWrong) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "lacks the key 'title'"},
      {"title = \"t\"\nbudgets = []\n", "there is no budget"},
      {"title = \"t\"\nbudgets = [2, 2]\n", ":2:11: budgets must rise"},
      {"title = \"t\"\nbudgets = [0]\n", "must be > 0"},
      {"title = \"t\"\nbudgets = 3\n", "must be an array"},
      {"unit = \"hours\"\n" + kHead, "cannot be 'hours'"},
      {"repetitions = 2\n" + kHead + kScene + kMethods, "must be from 3"},
      {kHead + kMethods, "the experiment has no scene"},
      {kHead + kScene, "the experiment compares nothing"},
      {kHead + kScene + kScene + kMethods, ":7:8: two scenes are named 'fog'"},
      {kHead + kScene + kMethods + "[[methods]]\nname = \"a\"\n", "two methods are named 'a'"},
      {kHead + "[product]\nintegrator.volume.radius = 0.1\n" + kScene + kMethods,
       ":4:28: 'integrator.volume.radius' of [product] must be"},
      {kHead + "[set]\nintegrator.volume.radius = 1979-05-27\n" + kScene + kMethods,
       ":4:28: a setting cannot be a date"},
      {kHead + "set = 3\n" + kScene + kMethods, "must be a table of settings, not an integer"},
      {kHead + "[[scenes]]\nname = \"x\"\nfile = \"none.toml\"\n" + kMethods, "there is no file"},
      {kHead + "[reference]\nerror = 1e-3\n" + kScene + "reference = \"exact\"\n" + kMethods,
       "no reference is rendered"},
      {kHead + kScene + "reference = { error = 0 }\n" + kMethods, "must be > 0"},
      {kHead + kScene + "reference = { errors = 1 }\n" + kMethods, "unknown key 'errors' in [scenes.reference]"},
      {kHead + kScene + kMethods + "[referees]\n", "unknown key 'referees'"}};
  for (const auto& [text, words] : cases) {
    const std::string found = message(text);
    EXPECT_NE(found.find(words), std::string::npos) << text << "\n" << found;
    EXPECT_NE(found.find("experiment.toml:"), std::string::npos) << found;
  }
}

TEST(ExperimentFile, RefusesProductsOfAbsurdSize) {
  std::string keys;
  for (int key = 10; key < 50; ++key) keys += "k" + std::to_string(key) + " = [1, 2]\n";
  const std::string found = message(kHead + "[product]\n" + keys + kScene);
  EXPECT_NE(found.find(":13:7: [product] makes more than 1000 methods"), std::string::npos) << found;
}

}  // namespace
}  // namespace vpm
