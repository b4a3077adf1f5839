// Renders that are watched: what a viewer is sent, byte for byte, that none of its faults matters to the picture, and
// files that are written again and again.
#include <signal.h>

#include <fmt/format.h>
#include <chrono>
#include <functional>
#include <thread>

#include "tools/ball_of_fog.h"
#include "tools/plume.h"
#include "tools/viewer.h"
#include "vpm/image/exr.h"
#include "vpm/image/png.h"

namespace vpm {
namespace {

using Json = nlohmann::json;

class VpmWatch : public VpmBinary {
 protected:
  void write_scene(int width, int height) const { write("fog.toml", ball_of_fog(width, height)); }
  /// From so far away that the fog covers few pixels, and passes take no time.
  void write_quick_scene(int width, int height) const {
    std::string scene = ball_of_fog(width, height);
    scene.replace(scene.find("[0, 0, 3]"), 9, "[0, 0, 40]");
    write("fog.toml", scene);
  }

  /// Renders to NAME.exr, with what is added.
  std::vector<std::string> render(const std::string& name, int passes,
                                  const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{"render", "fog.toml", "-o", name + ".exr", "--passes", std::to_string(passes)};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  /// Watched, the render succeeds, says one line that has each of `words`, and gives the picture that it gives
  /// unwatched. Returns how long it took, s.
  double renders_the_same(int passes, const ViewerPort& port, const std::vector<std::string>& words) const {
    vpm_succeeds(render("alone", passes));
    const ProcessResult watched = vpm_succeeds(render("watched", passes, {"--display", port.option()}));
    EXPECT_EQ(std::count(watched.err.begin(), watched.err.end(), '\n'), 1) << watched.err;
    expect_words(watched.err, words);
    EXPECT_TRUE(read("watched.exr") == read("alone.exr"));
    EXPECT_TRUE(read("watched.png") == read("alone.png"));
    EXPECT_EQ(without_circumstances(report("watched.json")), without_circumstances(report("alone.json")));
    return watched.seconds;
  }

  /// Renders to a.exr, watched by a viewer that reads all.
  ShownInViewer watched(int passes, std::vector<std::string> more) const {
    const ViewerPort port;
    port.listen();
    ShownInViewer shown;
    std::jthread viewer([&] {
      const Descriptor connection(port.accept());
      for (std::string packet; !(packet = receive_packet(connection)).empty();) shown.take(packet);
    });
    more.insert(more.end(), {"--display", port.option()});
    vpm_succeeds(render("a", passes, more));
    viewer.join();
    return shown;
  }
};

class SlowVpmWatch : public VpmWatch {};  // waits, and looks at the clock

// --- A viewer

std::string with_zeros(const char* text, size_t size) { return {text, size}; }

// The bytes are written after the description in [Mueller2025, README.md, Ipc.cpp: setCreateImage(), setUpdateImage()].
TEST_F(VpmWatch, AViewerIsSentTheBytesOfItsProtocol) {
  write_scene(2, 1);
  const ViewerPort port;
  port.listen();
  vpm_succeeds(render("a", 1,
                      {"--display", port.option(), "--set", "camera.fov=10", "--set",
                       "integrator.photons.emitted=200000", "--set", "lights.0.irradiance=[3, 2, 1]"}));
  const Descriptor connection(port.accept());
  const Image picture = read_exr(path("a.exr"));
  const Rgb &left = picture.pixels[0], &right = picture.pixels[1];
  EXPECT_TRUE(left.r > left.g && left.g > left.b && left.b > 0.0f && left != right);
  static const char create[] =
      "\x1e\0\0\0\x04\x01"  // 30 bytes: create an image, and show it
      "a.exr\0"
      "\x02\0\0\0\x01\0\0\0"  // width, height
      "\x03\0\0\0R\0G\0B";
  static const char update[] =
      "\x6e\0\0\0\x06\0"  // 110 bytes: update an image
      "a.exr\0"
      "\x03\0\0\0R\0G\0B\0"
      "\0\0\0\0\0\0\0\0\x02\0\0\0\x01\0\0\0"                   // x, y, width, height
      "\0\0\0\0\0\0\0\0\x01\0\0\0\0\0\0\0\x02\0\0\0\0\0\0\0"   // offsets
      "\x03\0\0\0\0\0\0\0\x03\0\0\0\0\0\0\0\x03\0\0\0\0\0\0";  // strides
  EXPECT_EQ(receive(connection, 30), with_zeros(create, sizeof(create)));
  EXPECT_EQ(receive(connection, 86), with_zeros(update, sizeof(update)));
  EXPECT_EQ(receive_all(connection), std::string(reinterpret_cast<const char*>(picture.pixels.data()), 24));
}

TEST_F(VpmWatch, TheViewersLastPictureIsThatOfTheFile) {
  write_quick_scene(400, 300);  // more than one packet holds
  const ShownInViewer shown = watched(3, {});
  EXPECT_EQ(shown.name, "a.exr");
  EXPECT_EQ(shown.created, 1);
  EXPECT_GE(shown.updates, 2);
  EXPECT_LE(shown.updates, 3);
  EXPECT_EQ(shown.packets, 1 + 2 * shown.updates);
  EXPECT_GT(sum(shown.picture), 0.0);
  EXPECT_TRUE(same_pixels(shown.picture, read_exr(path("a.exr"))));
}

TEST_F(VpmWatch, WherePassesAreQuickMostAreNotShownButTheLastIs) {
  write_quick_scene(400, 300);
  const ShownInViewer shown = watched(20, {"--set", "integrator.photons.emitted=20"});
  EXPECT_LE(shown.updates, 15);
  EXPECT_GT(sum(shown.picture), 0.0);
  EXPECT_TRUE(same_pixels(shown.picture, read_exr(path("a.exr"))));
}

TEST_F(VpmWatch, AViewerThatIsNotThereIsSaidAndChangesNothing) {
  write_scene(40, 30);
  const ViewerPort port;  // does not listen
  renders_the_same(3, port, {"note: no viewer shows the picture", "127.0.0.1:", "refused"});
}

TEST_F(VpmWatch, AViewerThatLeavesIsSaidOnceAndChangesNothing) {
  write_quick_scene(100, 80);
  const ViewerPort port;
  port.listen_with_little_room();
  ShownInViewer shown;
  std::jthread viewer([&] {
    const Descriptor connection(port.accept());
    for (std::string packet; shown.updates < 1 && !(packet = receive_packet(connection)).empty();) shown.take(packet);
  });
  renders_the_same(60, port, {"note: the viewer shows no more than ", "pass"});  // more than buffers hold
  viewer.join();
  EXPECT_EQ(shown.packets, 2);
}

TEST_F(SlowVpmWatch, AViewerThatDoesNotReadHoldsUpTheRenderForTwoSecondsAtMost) {
  write_quick_scene(300, 200);
  const ViewerPort port;
  port.listen_with_little_room();
  renders_the_same(30, port, {"note: the viewer shows no more than ", "timed out"});
  const Json times = report("watched.json")["times"];
  const double between_passes = times["total"].get<double>() - times["eye_pass"].get<double>();
  EXPECT_GE(between_passes, 2.0);
  EXPECT_LT(between_passes, 30.0);  // once, and not after each of the passes
}

TEST_F(SlowVpmWatch, AViewerThatTakesNoConnectionHoldsUpTheRenderForTwoSecondsAtMost) {
  write_scene(40, 30);
  const ViewerPort port;
  port.listen(0);
  const auto make = [] { return socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0); };
  const Descriptor first(make()), second(make());
  for (const int waiting : {int{first}, int{second}}) port.connect_from(waiting);
  const double seconds = renders_the_same(3, port, {"note: no viewer shows the picture", "timed out"});
  EXPECT_GE(seconds, 2.0);
}

TEST_F(VpmWatch, BadOptionsAreRefusedBeforeRendering) {
  write_scene(40, 30);
  for (const char* display : {"", "window", "tev:", "tev:14158", "tev:there", "tev::14158", "tev:there:0",
                              "tev:there:65536", "tev:there:x", "tev:there:1 "})
    vpm_refuses(render("a", 1'000'000'000, {"--display", display}), {"--display", "tev:HOST:PORT"});
  for (const char* seconds : {"0", "-1", "nan", "inf", "x"})
    vpm_refuses(render("a", 1'000'000'000, {"--preview", seconds}), {"--preview", "seconds above 0"});
}

// --- Files in the course of a render

/// Waits until something is so, a minute at most.
bool comes_true(const std::function<bool()>& is_so) {
  for (const Stopwatch waiting; waiting.seconds() < 60.0;) {
    if (is_so()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

class VpmPreview : public VpmWatch {
 protected:
  VpmPreview() { write_quick_scene(100, 80); }

  /// A render without an end, to be interrupted.
  std::vector<std::string> endless(const std::string& preview) const {
    return command(render("a", 1'000'000'000, {"--preview", preview, "--progress", "always"}));
  }
  /// Of the picture, which must be whole; 0 where there is none.
  int passes_of_picture() const {
    if (!std::filesystem::exists(path("a.exr"))) return 0;
    return std::stoi(read_exr_channels(path("a.exr")).metadata.at("vpm.passes"));
  }
  /// Ends the render, and compares its files with those of as many passes without preview.
  void ends_as_without_preview(Process& process) const {
    process.signal(SIGINT);
    EXPECT_EQ(process.wait().status, 130);
    vpm_succeeds(render("b", passes_of_picture()));
    EXPECT_TRUE(read("a.exr") == read("b.exr"));
    EXPECT_TRUE(read("a.png") == read("b.png"));
    EXPECT_EQ(report("a.json")["passes"], report("b.json")["passes"]);
    EXPECT_EQ(report("a.json")["error"], report("b.json")["error"]);
  }
};

TEST_F(VpmPreview, FilesAreThereBeforeTheEndWholeAndNewAgainAndAgain) {
  Process process(endless("0.01"), {100.0, 0, folder_.string()});
  ASSERT_TRUE(comes_true([&] { return std::filesystem::exists(path("a.json")); }));
  for (int last = 0, more = 0; more < 5; ++more) {
    EXPECT_TRUE(comes_true([&] { return passes_of_picture() > last; }));
    last = passes_of_picture();
    EXPECT_GE(report("a.json")["passes"], 1);
    EXPECT_EQ(read_png(path("a.png"), PngValues::srgb).width, 100);
  }
  ends_as_without_preview(process);
}

TEST_F(VpmPreview, FilesAreLeftAloneForSoManySeconds) {
  Process process(endless("1000"), {100.0, 0, folder_.string()});
  ASSERT_TRUE(comes_true([&] { return std::filesystem::exists(path("a.json")); }));
  EXPECT_TRUE(process.wait_for_error_output(", relative MSE below"));  // after eight passes
  EXPECT_EQ(passes_of_picture(), 1);
  ends_as_without_preview(process);
  EXPECT_GE(passes_of_picture(), 8);
}

TEST_F(VpmPreview, AFileThatCannotBeWrittenIsSaidAndEndsNothing) {
  Process process(endless("0.01"), {100.0, 0, folder_.string()});
  ASSERT_TRUE(comes_true([&] { return std::filesystem::exists(path("a.json")); }));
  std::error_code again;  // where the render is quicker
  EXPECT_TRUE(comes_true([&] {
    std::filesystem::remove(path("a.png"), again);
    return std::filesystem::create_directory(path("a.png"), again);
  }));
  EXPECT_TRUE(process.wait_for_error_output("warning: the run goes on without a preview: cannot write 'a.png'"));
  std::filesystem::remove(path("a.png"));
  ends_as_without_preview(process);
}

}  // namespace
}  // namespace vpm
