// Pieces of a render, and what they are merged to: the picture of one run, or a refusal.
#include <algorithm>

#include "tools/plume.h"
#include "vpm/image/exr.h"

namespace vpm {
namespace {

using Json = nlohmann::json;
using Arguments = std::vector<std::string>;

class VpmMerge : public VpmRender {
 protected:
  /// Renders the passes of a range, with more options, into NAME.exr, NAME.checkpoint and so on.
  ProcessResult piece(const std::string& name, const std::string& range, const Arguments& more = {}) const {
    return vpm(render(name, {"--pass-range", range, "--checkpoint"}, more));
  }
  static Arguments render(const std::string& name, const Arguments& options, const Arguments& more) {
    Arguments arguments{"render", "scene.toml", "-o", name + ".exr"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  /// Pieces of two passes, merged in the order of their numbers that is given.
  void expect_same_as_one_run(const Arguments& options, const std::vector<int>& order = {1, 0, 2}) const {
    const int passes = 2 * static_cast<int>(order.size());
    vpm_succeeds(render("one", {"--passes", std::to_string(passes), "--threads", "1"}, options));
    Arguments merge{"merge", "-o", "all.exr"};
    for (const int i : order) {
      ASSERT_EQ(piece(std::to_string(i), range_text(2 * i, 2 * i + 2), options).status, 0) << "piece " << i;
      merge.push_back(std::to_string(i) + ".checkpoint");
    }
    vpm_succeeds(merge);
    EXPECT_TRUE(read("all.exr") == read("one.exr"));
    EXPECT_TRUE(read("all.png") == read("one.png"));
    const Json all = report("all.json"), one = report("one.json");
    EXPECT_EQ(all["pass_ranges"], Json::array({Json::array({0, passes})}));
    for (const char* key : {"passes", "settings", "scene_hash", "overrides", "error", "techniques", "rendered_pixels"})
      EXPECT_EQ(all[key], one[key]) << key;
    for (const char* key : {"emitted", "stored_volume", "stored_surface"})
      EXPECT_EQ(all["photons"][key], one["photons"][key]) << key;
  }

  static std::string range_text(int first, int end) { return std::to_string(first) + ":" + std::to_string(end); }
};

TEST_F(VpmMerge, SevenPiecesInAnyOrderAreOneRun) { expect_same_as_one_run({}, {4, 0, 6, 2, 1, 5, 3}); }

TEST_F(VpmMerge, PiecesWithLayersOfACropAreOneRun) {
  expect_same_as_one_run({"--layers", "depth,samples,transmittance", "--crop", "7,3,39,20", "--seed", "77"});
}

TEST_F(VpmMerge, PiecesOfPassesInBlocksAreOneRun) {
  const Arguments layers{"--layers", "depth,samples", "--crop", "7,3,39,20"};
  Arguments blocks = layers;
  blocks.insert(blocks.end(), {"--set", "integrator.photons.block=1500"});
  expect_same_as_one_run(blocks);
  vpm_succeeds(render("whole", {"--passes", "6"}, layers));
  const ExrChannels all = read_exr_channels(path("all.exr")), whole = read_exr_channels(path("whole.exr"));
  EXPECT_EQ(all.held, whole.held);
  size_t of_view = 0;
  for (const auto& [name, plane] : whole.planes)
    if (name.starts_with("depth") || name.starts_with("samples")) {
      ++of_view;
      EXPECT_EQ(all.planes.at(name), plane) << name;
    }
  EXPECT_GE(of_view, 2u);
  EXPECT_NEAR(sum(read_exr(path("all.exr"))), sum(read_exr(path("whole.exr"))), 1e-4);
}

TEST_F(VpmMerge, PiecesOfTechniquesCombinedAreOneRun) {
  expect_same_as_one_run(
      {"--set", "integrator.type=combined", "--layers", "combined", "--set", "integrator.photons.emitted=1000"});
}

// The scene has a time to render for, by which each piece would choose by its own clock.
TEST_F(VpmMerge, PiecesChooseAlike) {
  expect_same_as_one_run({"--auto", "--set", "integrator.volume.radius=auto", "--set", "integrator.type=photon-map"});
  write("scene.toml", std::string(kScene).replace(std::string(kScene).find("passes = 2"), 10, "seconds = 3"));
  const Arguments automatic{
      "--set", "integrator.volume.radius=auto", "--set", "integrator.photons.emitted=auto", "--spp", "16"};
  EXPECT_EQ(piece("a", "0:1", automatic).status, 0);
  EXPECT_EQ(piece("b", "1:3", automatic).status, 0);
  EXPECT_EQ(report("a.json")["chosen"], report("b.json")["chosen"]) << "with the costs that are told as reasons";
  vpm_succeeds({"merge", "b.checkpoint", "a.checkpoint", "-o", "ab.exr"});
}

TEST_F(VpmMerge, OnePieceIsThePictureOfItsPasses) {
  ASSERT_EQ(piece("a", "3:5").status, 0);
  EXPECT_EQ(report("a.json")["pass_ranges"], Json::parse("[[3, 5]]"));
  EXPECT_EQ(read_exr_channels(path("a.exr")).metadata.at("vpm.passes"), "2");
  vpm_succeeds({"render", "scene.toml", "-o", "first.exr", "--passes", "2"});
  EXPECT_FALSE(same_pixels(read_exr(path("a.exr")), read_exr(path("first.exr"))));
}

TEST_F(VpmMerge, APieceTellsThatTimeAndErrorDoNotCount) {
  const Arguments seconds{"--set", "render.seconds=0.001"}, error{"--set", "render.error=100"};
  Arguments both = seconds;
  both.insert(both.end(), error.begin(), error.end());
  for (const Arguments& rules : {Arguments{}, seconds, error, both}) {
    Arguments options = rules;
    options.push_back("--overwrite");
    const ProcessResult made = piece("a", "0:2", options);
    ASSERT_EQ(made.status, 0);
    const auto told = [&](const char* key) { return made.err.find(key) != std::string::npos; };
    EXPECT_EQ(told("'seconds' of [render] does not count"), rules == seconds || rules == both) << made.err;
    EXPECT_EQ(told("'error' of [render] does not count"), rules == error || rules == both) << made.err;
    EXPECT_EQ(report("a.json")["pass_ranges"], Json::parse("[[0, 2]]"));
  }
}

TEST_F(VpmMerge, PiecesThatAreKilledGoOn) {
  ASSERT_EQ(piece("a", "2:3").status, 0);
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--pass-range", "2:6", "--resume"});
  ASSERT_EQ(piece("whole", "2:6").status, 0);
  EXPECT_TRUE(read("a.exr") == read("whole.exr"));
  vpm_refuses({"render", "scene.toml", "-o", "a.exr", "--resume"}, {"begins with pass 2, but the render with pass 0"});
  vpm_refuses({"render", "scene.toml", "-o", "a.exr", "--resume", "--pass-range", "3:6"}, {"begins with pass 2"});
}

TEST_F(VpmMerge, TheWholeGoesOnFromItsCheckpoint) {
  ASSERT_EQ(piece("a", "0:2").status, 0);
  ASSERT_EQ(piece("b", "2:3").status, 0);
  vpm_succeeds({"merge", "a.checkpoint", "b.checkpoint", "-o", "all.exr", "--checkpoint"});
  vpm_succeeds({"render", "scene.toml", "-o", "all.exr", "--passes", "5", "--resume"});
  vpm_succeeds({"render", "scene.toml", "-o", "one.exr", "--passes", "5"});
  EXPECT_TRUE(read("all.exr") == read("one.exr"));
  vpm_refuses({"merge", "a.checkpoint", "b.checkpoint", "-o", "all.exr", "--checkpoint"},
              {"all.checkpoint' is there already", "--overwrite"});
  vpm_succeeds({"merge", "a.checkpoint", "b.checkpoint", "-o", "all.exr", "--checkpoint", "--overwrite"});
}

TEST_F(VpmMerge, GapsAndOverlapsAreRefused) {
  ASSERT_EQ(piece("a", "0:2").status, 0);
  ASSERT_EQ(piece("b", "3:4").status, 0);
  ASSERT_EQ(piece("c", "1:3").status, 0);
  const std::vector<std::string> before = files();
  vpm_refuses({"merge", "b.checkpoint", "a.checkpoint"}, {"passes 2 are missing"});
  vpm_refuses({"merge", "b.checkpoint", "-o", "all.exr"}, {"passes 0 to 2 are missing"});
  vpm_refuses({"merge", "a.checkpoint", "c.checkpoint", "b.checkpoint"},
              {"cannot merge 'c.checkpoint'", "both have some of 1 to 2", "so far passes 0 to 1 are merged"});
  vpm_refuses({"merge", "a.checkpoint", "a.checkpoint"}, {"both have some of 0 to 1"});
  vpm_refuses({"merge", "a.checkpoint", "a.exr"}, {"'a.exr'", "it is no checkpoint"});
  vpm_refuses({"merge", "a.checkpoint", "none.checkpoint"}, {"'none.checkpoint'", "there is no such file"});
  vpm_refuses({"merge", "a.checkpoint", "-o", "all.png"}, {"its name must end in .exr"});
  EXPECT_EQ(files(), before);
}

TEST_F(VpmMerge, PiecesOfOtherRendersAreRefused) {
  ASSERT_EQ(piece("a", "0:1").status, 0);
  ASSERT_EQ(piece("seed", "1:2", {"--seed", "9"}).status, 0);
  ASSERT_EQ(piece("radius", "1:2", {"--set", "integrator.volume.radius=0.2"}).status, 0);
  vpm_refuses({"merge", "a.checkpoint", "seed.checkpoint"},
              {"they are of two renders", "render.seed: 1 in 'a.checkpoint', 9 in 'seed.checkpoint'"});
  vpm_refuses({"merge", "a.checkpoint", "radius.checkpoint"},
              {"integrator.volume.radius: 0.1 in 'a.checkpoint', 0.2 in 'radius.checkpoint'"});
}

TEST_F(VpmMerge, TheSceneMustBeThatOfThePieces) {
  ASSERT_EQ(piece("a", "0:1").status, 0);
  std::filesystem::rename(path("scene.toml"), path("moved.toml"));
  vpm_refuses({"merge", "a.checkpoint"}, {"scene.toml' is not there", "--scene"});
  vpm_succeeds({"merge", "a.checkpoint", "-o", "all.exr", "--scene", "moved.toml"});
  write("moved.toml", std::string(kScene).replace(std::string(kScene).find("power = 10"), 10, "power = 11"));
  vpm_refuses({"merge", "a.checkpoint", "-o", "all.exr", "--scene", "moved.toml"},
              {"its scene or this program is another now", "lights.lamp.power: 10 in the checkpoint, 11 now"});
}

TEST_F(VpmMerge, NamesOfFilesMayBeAnyBytes) {
  const std::string name = "b\xff\\n\nc";
  std::filesystem::rename(path("scene.toml"), path(name + ".toml"));
  std::filesystem::rename(path("smoke.vdb"), path(name + ".vdb"));
  const std::string grid = "media.smoke.path=" + name + ".vdb";
  for (const char* range : {"0:1", "1:2"})
    vpm_succeeds({"render", name + ".toml", "-o", std::string(1, *range) + ".exr", "--set", "media.smoke.sigma_t=20",
                  "--set", grid, "--pass-range", range, "--checkpoint"});
  vpm_succeeds({"merge", "0.checkpoint", "1.checkpoint", "-o", "all.exr"});
  vpm_succeeds(
      {"render", name + ".toml", "-o", "one.exr", "--set", "media.smoke.sigma_t=20", "--set", grid, "--passes", "2"});
  EXPECT_TRUE(read("all.exr") == read("one.exr"));
}

TEST_F(VpmMerge, RangesThatCannotBeAreRefused) {
  for (const char* range : {"4", "4:4", "5:4", "-1:4", "0:4:8", "a:b", ":", "0:99999999999"})
    vpm_refuses({"render", "scene.toml", std::string("--pass-range=") + range}, {"no range of passes such as 0:64"});
  vpm_refuses({"render", "scene.toml", "--pass-range", "0:4", "--time", "3"}, {"--time"});
  vpm_refuses({"render", "scene.toml", "--pass-range", "0:4", "--passes", "3"}, {"there are 3 in all, 0:3"});
  vpm_refuses({"render", "scene.toml", "--pass-range", "1:4", "--set", "integrator.radii=per-pixel"},
              {"no piece begins with pass 1"});
}

TEST_F(VpmMerge, TheExampleOfAJobArrayMakesOnePicture) {
  const auto run = [&](Arguments arguments) {
    arguments.insert(arguments.begin(),
                     {"/usr/bin/env", "VPM=" VPM_BINARY, VPM_SOURCE_DIR "/tools/examples/job_array"});
    return Process(arguments, {60.0, 0, folder_.string()}).wait();
  };
  for (const char* number : {"1", "0", "2", "1"})
    EXPECT_EQ(run({"piece", number, "3", "7", "out", "scene.toml", "--seed", "4"}).status, 0) << number;
  EXPECT_EQ(run({"merge", "out"}).status, 0);
  std::filesystem::rename(path("out/2.checkpoint"), path("out/kept"));
  EXPECT_EQ(run({"merge", "out"}).status, 2) << "the last piece is missing";
  vpm_succeeds({"render", "scene.toml", "-o", "one.exr", "--passes", "7", "--seed", "4"});
  EXPECT_TRUE(read("out/picture.exr") == read("one.exr"));
  EXPECT_EQ(run({"piece", "3", "3", "7", "out", "scene.toml"}).status, 2) << "0, 1 and 2 are all";
  const ProcessResult usage = run({});
  EXPECT_EQ(usage.status, 2);
  expect_words(usage.err, {"job_array piece NUMBER", "sbatch"});
}

}  // namespace
}  // namespace vpm
