// Renders that end early or stop by themselves: what is kept, and what is said.
#include <signal.h>

#include <fmt/format.h>
#include <chrono>
#include <cmath>
#include <sstream>
#include <thread>

#include "tools/plume.h"
#include "vpm/image/exr.h"

namespace vpm {
namespace {

using Json = nlohmann::json;

// --- Interruption

/// Starts a render, sends it the signal when `sign` is in its error output, and waits for its end.
ProcessResult interrupt(Process& process, int signal, const std::string& sign) {
  EXPECT_TRUE(process.wait_for_error_output(sign));
  process.signal(signal);
  return process.wait();
}

TEST_F(VpmRender, AnInterruptedRenderKeepsItsFinishedPasses) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Process process(command({"render", "scene.toml", "-o", "a.exr", "--time", "50", "--progress", "always"}),
                    {60.0, 0, folder_.string()});
    // Of a render by time the time left is told once a pass is finished.
    const ProcessResult result = interrupt(process, signal, " left");
    EXPECT_EQ(result.status, 130) << result.err;
    const int passes = report("a.json")["passes"];
    EXPECT_GE(passes, 1);
    EXPECT_NE(result.err.find(fmt::format("interrupted after {} pass", passes)), std::string::npos) << result.err;
    EXPECT_EQ(read_exr_channels(path("a.exr")).metadata.at("vpm.passes"), std::to_string(passes));
    vpm_succeeds({"render", "scene.toml", "-o", "whole.exr", "--passes", std::to_string(passes)});
    EXPECT_TRUE(read("a.exr") == read("whole.exr"));
    EXPECT_EQ(files(), (std::vector<std::string>{"a.exr", "a.json", "a.png", "scene.toml", "smoke.vdb", "whole.exr",
                                                 "whole.json", "whole.png"}));
  }
}

/// As those that nohup and a shell's background start.
TEST_F(VpmRender, SignalsThatAreIgnoredAtItsStartStaySo) {
  std::vector<std::string> shell = {"/bin/sh", "-c", "trap '' INT TERM HUP; exec \"$@\"", "sh"};
  for (const std::string& word :
       command({"render", "scene.toml", "-o", "a.exr", "--passes", "3", "--progress", "always"}))
    shell.push_back(word);
  Process process(shell, {60.0, 0, folder_.string()});
  EXPECT_TRUE(process.wait_for_error_output("render  ["));
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) process.signal(signal);
  EXPECT_EQ(process.wait().status, 0);
  EXPECT_EQ(report("a.json")["passes"], 3);
}

TEST_F(VpmRender, ARenderInterruptedInItsFirstPassLeavesNothing) {
  const std::vector<std::string> before = files();
  for (const char* slow : {"render.samples_per_pixel=64", "integrator.photons.emitted=100_000_000"}) {
    Process process(command({"render", "scene.toml", "-o", "a.exr", "--set", slow, "--set", "film.width=1024", "--set",
                             "film.height=1024", "--progress", "always"}),
                    {20.0, 0, folder_.string()});
    const ProcessResult result = interrupt(process, SIGINT, "render  [");
    EXPECT_EQ(result.status, 130) << result.err;
    EXPECT_NE(result.err.find("nothing is written"), std::string::npos) << result.err;
    EXPECT_EQ(files(), before);
  }
}

// Whatever it is at: one walk of a photon in a medium of a million mean free paths, or the building of maps.
TEST_F(VpmRender, ARenderIsInterruptedInTheMidstOfAPass) {
  const std::vector<std::string> before = files();
  for (const char* slow : {"media.smoke.sigma_t=1e7", "integrator.volume.radius=100"}) {
    Process process(
        command({"render", "scene.toml", "-o", "a.exr", "--set", slow, "--set", "integrator.photons.emitted=1_000_000",
                 "--set", "film.width=1024", "--set", "film.height=1024", "--progress", "always"}),
        {60.0, 0, folder_.string()});
    EXPECT_TRUE(process.wait_for_error_output("render  ["));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    process.signal(SIGINT);
    const ProcessResult result = process.wait();
    EXPECT_EQ(result.status, 130) << slow << result.err;
    EXPECT_EQ(files(), before);
  }
}

/// Also where it has shown a first picture, and written its scene.
TEST_F(VpmRender, AViewInterruptedInItsFirstPassLeavesNothing) {
  const std::vector<std::string> before = files();
  const auto view = command({"view", "smoke.vdb", "-o", "a.exr", "--scene", "a.toml", "--passes", "2", "--set",
                             "integrator.photons.emitted=100_000_000", "--progress", "always"});
  Process process(view, {60.0, 0, folder_.string()});
  const ProcessResult result = interrupt(process, SIGINT, "render  [");
  EXPECT_EQ(result.status, 130) << result.err;
  expect_words(result.err, {"nothing is written"});
  EXPECT_EQ(files(), before);
  write("a.png", "of an earlier render");
  Process again(view, {60.0, 0, folder_.string()});
  EXPECT_EQ(interrupt(again, SIGINT, "render  [").status, 130);
  EXPECT_EQ(read("a.png"), "of an earlier render");
}

// --- Time

TEST_F(VpmRender, WhereNotOnePassFitsIntoTheTimeItSaysSo) {
  const std::vector<std::string> before = files();
  const ProcessResult result = vpm({"render", "scene.toml", "-o", "a.exr", "--time", "0.5", "--set",
                                    "integrator.photons.emitted=80_000_000", "--set", "integrator.volume.radius=0.2"});
  EXPECT_EQ(result.status, 3) << result.err;
  expect_words(result.err, {"no pass is finished within the 0.5 s asked for"});
  EXPECT_EQ(files(), before);
}

// `timeout` signals the process, and then its group.
TEST_F(VpmRender, SignalsInQuickSuccessionAreOne) {
  Process process(command({"render", "scene.toml", "-o", "a.exr", "--time", "50", "--progress", "always"}),
                  {60.0, 0, folder_.string()});
  EXPECT_TRUE(process.wait_for_error_output(" left"));
  process.signal(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const ProcessResult result = interrupt(process, SIGINT, " left");
  EXPECT_EQ(result.status, 130) << result.err;
  EXPECT_NE(result.err.find("interrupted after "), std::string::npos) << result.err;
  EXPECT_GE(report("a.json")["passes"], 1);
}

TEST_F(VpmRender, UnderNohupTheEndOfTheTerminalIsNoInterruption) {
  Process process(
      {"/bin/sh", "-c",
       std::string("trap '' HUP; exec ") + VPM_BINARY + " render scene.toml -o a.exr --passes 40 --progress always"},
      {60.0, 0, folder_.string()});
  EXPECT_EQ(interrupt(process, SIGHUP, " left").status, 0);
  EXPECT_EQ(report("a.json")["passes"], 40);
}

TEST_F(VpmRender, AnInterruptedRenderOfSoManyPassesTellsHowManyAreDone) {
  Process process(command({"render", "scene.toml", "-o", "a.exr", "--passes", "100000", "--progress", "always"}),
                  {60.0, 0, folder_.string()});
  EXPECT_TRUE(process.wait_for_error_output(" left"));
  std::this_thread::sleep_for(std::chrono::seconds(1));
  const ProcessResult result = interrupt(process, SIGINT, " left");
  EXPECT_NE(result.err.find(" of 100000 passes"), std::string::npos) << result.err;
}

// --- Errors

TEST_F(VpmRender, StopsAtAnError) {
  for (const char* error : {"0", "-1", "nan"}) vpm_refuses({"render", "scene.toml", "--error", error}, {"--error"});
  vpm_refuses({"render", "scene.toml", "--error", "0.1", "--passes", "3"}, {"--error"});
  const ProcessResult coarse = vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--error", "0.2"});
  vpm_succeeds({"render", "scene.toml", "-o", "b.exr", "--error", "0.02"});
  const Json a = report("a.json"), b = report("b.json");
  EXPECT_LE(a["error"]["below_with_confidence_of_80_percent"], 0.2);
  EXPECT_LE(b["error"]["below_with_confidence_of_80_percent"], 0.02);
  EXPECT_GT(b["passes"], a["passes"]);
  EXPECT_NE(coarse.out.find("relative MSE "), std::string::npos) << coarse.out;
}

TEST_F(VpmRender, LogsErrorsAgainstAReference) {
  vpm_succeeds({"render", "scene.toml", "-o", "truth.exr", "--passes", "12"});
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--passes", "12", "--reference", "truth.exr"});
  const auto rows_of = [&](const std::string& file) {
    std::istringstream csv(read(file));
    std::string line;
    std::getline(csv, line);
    EXPECT_EQ(line, "passes,seconds,mse,relative_mse,mean_ratio,stated,standard_error,below");
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
  EXPECT_TRUE(std::isnan(rows[6][5]));
  EXPECT_GT(rows[11][5], 0.0);
  EXPECT_GT(rows[11][7], rows[11][5]);
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

}  // namespace
}  // namespace vpm
