// Checkpoints: renders that go on are the same as of one run, and no other render goes on from them.
#include <signal.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "tools/plume.h"

namespace vpm {
namespace {

using Json = nlohmann::json;

TEST_F(VpmRender, ACheckpointIsReplacedWhereThatIsAskedFor) {
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--passes", "2", "--checkpoint"});
  const std::string before = read("a.checkpoint");
  vpm_refuses({"render", "scene.toml", "-o", "a.exr", "--passes", "3", "--checkpoint"},
              {"a.checkpoint", "--resume", "--overwrite"});
  EXPECT_TRUE(read("a.checkpoint") == before);
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--passes", "3", "--checkpoint", "--overwrite"});
  EXPECT_FALSE(read("a.checkpoint") == before);
}

TEST_F(VpmRender, TwoRunsDoNotWriteOneCheckpoint) {
  Process first(
      command({"render", "scene.toml", "-o", "a.exr", "--time", "50", "--checkpoint", "--progress", "always"}),
      {60.0, 0, folder_.string()});
  EXPECT_TRUE(first.wait_for_error_output(" left"));
  for (int i = 0; i < 1000 && !std::filesystem::exists(path("a.checkpoint")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const ProcessResult second = vpm({"render", "scene.toml", "-o", "a.exr", "--time", "0.1", "--resume"});
  EXPECT_EQ(second.status, 2);
  EXPECT_NE(second.err.find("a.checkpoint.lock' is locked: another run"), std::string::npos) << second.err;
  first.signal(SIGKILL);
  first.wait();
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--time", "0.1", "--resume"});
  EXPECT_FALSE(std::filesystem::exists(path("a.checkpoint.lock")));
}

TEST_F(VpmRender, KilledAtAnyMomentItResumesToTheSameBits) {
  const std::vector<std::string> passes{"--passes", "40", "--set", "integrator.photons.emitted=3_000"};
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
  const ProcessResult fewer = vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--passes", "2", "--resume"});
  EXPECT_NE(fewer.err.find("the checkpoint has 5 passes already"), std::string::npos) << fewer.err;
  EXPECT_TRUE(read("a.exr") == read("whole.exr"));
  const ProcessResult late = vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--time", "1e-6", "--resume"});
  EXPECT_NE(late.err.find("the checkpoint has 5 passes already"), std::string::npos) << late.err;
  EXPECT_TRUE(read("a.exr") == read("whole.exr"));
  vpm_refuses({"render", "scene.toml", "-o", "a.exr", "--resume", "--seed", "9"},
              {"another render", "render.seed: 1 in the checkpoint, 9 asked for"});
  vpm_refuses({"render", "scene.toml", "-o", "a.exr", "--resume", "--set", "film.width=20"}, {"another render"});
  vpm_refuses({"render", "scene.toml", "-o", "b.exr", "--resume"}, {"b.checkpoint", "there is no such file"});
  vpm_succeeds({"media", "smoke", "--resolution", "17", "-o", "smoke.vdb"});  // other bytes under the same name
  vpm_refuses({"render", "scene.toml", "-o", "a.exr", "--resume"},
              {"another render", "file 1, smoke.vdb: bytes of hash "});
}

TEST_F(VpmRender, ACheckpointTellsInWhatAnotherSceneDiffers) {
  const auto with = [&](const std::string& what, const std::string& other) {
    std::string scene = kScene;
    write("scene.toml", scene.replace(scene.find(what), what.size(), other));
  };
  const auto resumed = [&](int passes, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"render",   "scene.toml",          "-o", "a.exr", "--resume",
                                       "--passes", std::to_string(passes)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  with("[integrator.volume]\nradius = 0.1", "");
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--passes", "1", "--checkpoint"});
  vpm_refuses(resumed(2, {"--set", "integrator.volume.radius=0.2", "--set", "media.smoke.albedo=[0.9, 0.8, 0.6]",
                          "--set", "lights.lamp.power=11"}),
              {"is of another render; render on with the options that it began with\n  media.smoke.albedo: [0.9, 0.8, "
               "0.7] in the checkpoint, [0.9, 0.8, 0.6] asked for\n  lights.lamp.power: 10 in the checkpoint, 11 asked "
               "for\n  integrator.volume.radius: ",
               " in the checkpoint, 0.2 asked for\n"});
  vpm_refuses(resumed(2, {"--set", "shapes.0.name=floor"}), {"shapes.floor.name: nothing in the checkpoint, floor"});
  // Neither comments nor how many passes are asked for make another scene, wherever they stand.
  with(
      "[render]\npasses = 2\n"
      "[integrator.photons]\nemitted = 10_000\n"
      "[integrator.volume]\nradius = 0.1",
      "# a comment\n"
      "[render]\npasses = 5\nseed = 1\n"
      "[integrator.photons]\nemitted = 10_000\n");
  vpm_succeeds(resumed(2));
  vpm_succeeds(resumed(3, {"--set", "render.passes=7", "--set", "integrator.volume.type=radius"}));
}

TEST_F(VpmRender, RadiiOfPixelsResumeToTheSameBits) {
  const auto render = [&](const std::string& name, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"render", "scene.toml", "-o", name, "--set", "integrator.radii=per-pixel"};
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
  EXPECT_EQ(a["error"]["bias_not_seen_of"], Json::array());
  vpm_succeeds({"render", "scene.toml", "-o", "b.exr"});
  EXPECT_TRUE(report("b.json")["radii_of_pixels"].is_null());
  vpm_refuses({"render", "scene.toml", "-o", "a.exr", "--resume"},
              {"another render", "integrator.radii: per-pixel in the checkpoint, per-pass asked for"});
}

}  // namespace
}  // namespace vpm
