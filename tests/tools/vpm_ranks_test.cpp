// vpm render as several processes: by mpiexec where it is built with MPI, and refused where it is not.
#include <fmt/format.h>
#include <signal.h>
#include <algorithm>
#include <chrono>
#include <thread>

#include "tools/plume.h"

namespace vpm {
namespace {

using Arguments = std::vector<std::string>;

class VpmRanks : public VpmRender {
 protected:
  void SetUp() override {
#ifndef VPM_MPIEXEC
    GTEST_SKIP() << "built without MPI: tools/build mpi";
#endif
  }
#ifdef VPM_MPIEXEC
  /// The binary as so many ranks, more than there are cores.
  Arguments ranks(int count, const Arguments& arguments) const {
    Arguments all{"/usr/bin/env",
                  "OMPI_ALLOW_RUN_AS_ROOT=1",
                  "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
                  VPM_MPIEXEC,
                  "--oversubscribe",
                  "--bind-to",
                  "none",
                  "-n",
                  std::to_string(count)};
    for (const std::string& argument : command(arguments)) all.push_back(argument);
    return all;
  }
#else
  Arguments ranks(int, const Arguments&) const { return {}; }
#endif
  ProcessResult run(int count, const Arguments& arguments) const {
    return Process(ranks(count, arguments), {120.0, 0, folder_.string()}).wait();
  }
};

TEST_F(VpmRanks, AnyNumberOfRanksAndThreadsGivesTheSameBits) {
  vpm_succeeds({"render", "scene.toml", "-o", "one.exr", "--passes", "9", "--threads", "1"});
  for (const auto& [count, threads] : {std::pair{1, "2"}, {2, "1"}, {4, "2"}, {8, "1"}}) {
    const ProcessResult result =
        run(count, {"render", "scene.toml", "-o", "all.exr", "--passes", "9", "--threads", threads});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(read("all.exr") == read("one.exr")) << count << " ranks of " << threads << " threads";
    EXPECT_EQ(without_circumstances(report("all.json")), without_circumstances(report("one.json")));
  }
}

TEST_F(VpmRanks, OneOfAMachineReadsTheGrids) {
  // The second rank has a scene of its own, whose grid it would refuse: it finds but that the render is another.
  std::filesystem::create_directory(path("other"));
  write("other/scene.toml", kScene);
  write("other/smoke.vdb", "no grid");
  Arguments arguments = ranks(1, {"render", "scene.toml", "-o", "a.exr"});
  const Arguments other = ranks(1, {"render", "other/scene.toml", "-o", "a.exr"});
  arguments.emplace_back(":");
  arguments.insert(arguments.end(), std::find(other.begin(), other.end(), "-n"), other.end());
  const ProcessResult result = Process(arguments, {120.0, 0, folder_.string()}).wait();
  EXPECT_EQ(result.status, 2);
  expect_words(result.err, {"rank 1: this rank would render something else", "smoke.vdb"});
}

TEST_F(VpmRanks, RanksUseWhatTheFirstChooses) {
  const Arguments chosen{"--auto",
                         "--set",
                         "integrator.volume.radius=auto",
                         "--set",
                         "integrator.type=photon-map",
                         "--crop",
                         "3,2,30,20",
                         "--layers",
                         "depth",
                         "--passes",
                         "8"};
  const auto render = [&](const std::string& image) {
    Arguments arguments{"render", "scene.toml", "-o", image};
    arguments.insert(arguments.end(), chosen.begin(), chosen.end());
    return arguments;
  };
  vpm_succeeds(render("one.exr"));
  const ProcessResult result = run(3, render("all.exr"));
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(read("all.exr") == read("one.exr"));
}

TEST_F(VpmRanks, WhatIsWrongIsToldOnce) {
  const ProcessResult result = run(3, {"render", "scene.toml", "-o", "a.exr", "--set", "film.width=0"});
  EXPECT_EQ(result.status, 2);
  const size_t first = result.err.find("film.width");
  EXPECT_NE(first, std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("film.width", first + 20), std::string::npos) << result.err;
  write("smoke.vdb", "no grid");
  const ProcessResult grid = run(3, {"render", "scene.toml", "-o", "a.exr"});
  EXPECT_EQ(grid.status, 2);
  const size_t told = grid.err.find("smoke.vdb: ");
  EXPECT_NE(told, std::string::npos) << grid.err;
  EXPECT_EQ(grid.err.find("smoke.vdb: ", told + 1), std::string::npos) << grid.err;
}

TEST_F(VpmRanks, WhatRank0RefusesIsNoFaultOfSharing) {
  const ProcessResult result = run(3, {"render", "scene.toml", "-o", "nowhere/a.exr"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("nowhere"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("note: "), std::string::npos) << result.err;
}

TEST_F(VpmRanks, RadiiOfPixelsAreRefused) {
  const ProcessResult radii = run(2, {"render", "scene.toml", "-o", "a.exr", "--set", "integrator.radii=per-pixel"});
  EXPECT_EQ(radii.status, 2);
  expect_words(radii.err, {"no other rank can make the next pass"});
}

TEST_F(VpmRanks, ARankThatIsKilledEndsTheJobAndWhatIsFinishedIsKept) {
  Process process(ranks(3, {"render", "scene.toml", "-o", "a.exr", "--passes", "100000", "--checkpoint", "--threads",
                            "1", "--progress", "always"}),
                  {60.0, 0, folder_.string()});
  for (int i = 0; i < 2000 && !std::filesystem::exists(path("a.checkpoint")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  // The last rank is the youngest process with this output.
  const ProcessResult killed = Process({"/usr/bin/pkill", "-KILL", "-n", "-f",
                                        "vpm render scene.toml -o a.exr --passes "
                                        "100000"},
                                       {10.0, 0, folder_.string()})
                                   .wait();
  EXPECT_EQ(killed.status, 0);
  EXPECT_NE(process.wait().status, 0);
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--passes", "1", "--resume"});
  const int passes = report("a.json")["passes"];
  EXPECT_GE(passes, 1);
  vpm_succeeds({"render", "scene.toml", "-o", "one.exr", "--passes", std::to_string(passes)});
  EXPECT_TRUE(read("a.exr") == read("one.exr"));
}

TEST_F(VpmRanks, OtherCommandsAreRefused) {
  const ProcessResult result = run(2, {"info", "scene.toml"});
  EXPECT_EQ(result.status, 2);
  expect_words(result.err, {"only render shares its work"});
}

class VpmWithoutRanks : public VpmRender {};

TEST_F(VpmWithoutRanks, IsNoOneOfSeveral) {
#ifdef VPM_MPIEXEC
  GTEST_SKIP() << "built with MPI";
#endif
  const auto as_one_of_two = [&](const std::string& variable, const std::string& name) {
    return Process({"/usr/bin/env", variable + "=2", VPM_BINARY, name, "scene.toml"}, {60.0, 0, folder_.string()})
        .wait();
  };
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    const ProcessResult render = as_one_of_two(variable, "render");
    EXPECT_EQ(render.status, 2);
    expect_words(render.err, {"this vpm knows no MPI", "tools/build mpi"});
    EXPECT_EQ(as_one_of_two(variable, "info").status, 2);
  }
}

}  // namespace
}  // namespace vpm
