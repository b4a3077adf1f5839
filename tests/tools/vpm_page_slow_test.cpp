// The page of a comparison: what is in the file, and what a browser makes of it.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <optional>
#include <sstream>

#include "image/exr.h"
#include "tools/ball_of_fog.h"
#include "tools/vpm_binary.h"

namespace vpm {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kWidth = 12, kHeight = 8;

const std::string kScene =
    "# </script><script>fail('a scene\\'s text is no script')</script>\n" + ball_of_fog(kWidth, kHeight);

/// Two scenes and two methods. What texts mean in HTML, and the names of places in the template, mean nothing here.
constexpr const char* kExperiment = R"(
title = "Kernels </script><script>fail('a title is no script')</script> &amp; @about@ \"é\""
unit = "passes"
budgets = [1, 2, 4]
repetitions = 3
[product]
volume.radius = [0.2, 0.4]
[[scenes]]
name = "known"
file = "fog.toml"
reference = "known.exr"
[[scenes]]
name = "again"
file = "fog.toml"
reference = "known.exr"
)";

/// A picture whose every value is another.
Image known_picture() {
  Image image(kWidth, kHeight);
  for (size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = Rgb(0.001f, 0.0013f, 0.0017f) * (1.0f + static_cast<float>(i));
  return image;
}

/// A browser, where there is one.
std::optional<std::string> chromium() {
  const char* folders = std::getenv("PATH");
  std::istringstream path(folders ? folders : "");
  for (std::string folder; std::getline(path, folder, ':');)
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
      if (const fs::path file = fs::path(folder) / name; access(file.c_str(), X_OK) == 0) return file.string();
  return std::nullopt;
}

void replace(std::string& text, const std::string& what, const std::string& by) {
  const size_t at = text.rfind(what);
  ASSERT_NE(at, std::string::npos) << what;
  text.replace(at, what.size(), by);
}

std::string file_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

class VpmPage : public VpmBinary {
 protected:
  VpmPage() {
    write("fog.toml", kScene);
    write("experiment.toml", kExperiment);
    write_exr(path("known.exr"), known_picture(), {}, {});
    vpm_succeeds({"compare", "experiment.toml", "-o", "out"});
  }

  /// The page with what checks it: what comes first catches errors, what comes last asks questions about a pixel.
  void write_checked_page(int x, int y) const {
    std::string page = read("out/report.html");
    const Rgb value = known_picture().at(x, y);
    const json pixel{{"x", x}, {"y", y}, {"value", {value.r, value.g, value.b}}};
    const fs::path folder = fs::path(VPM_SOURCE_DIR) / "tests/tools";
    replace(page, "<style>", fmt::format("<script>\n{}</script>\n<style>", file_text(folder / "page_errors.js")));
    replace(page, "</body>",
            fmt::format("<script>\nconst kPixel = {};\n{}</script>\n</body>", pixel.dump(),
                        file_text(folder / "page_check.js")));
    write("checked.html", page);
  }

  /// What the page says of itself in a window of that width, pixels.
  std::string verdict(const std::string& browser, int width) const {
    const ProcessResult result =
        run_program({browser, "--headless", "--no-sandbox", "--disable-gpu", "--user-data-dir=" + path("profile"),
                     fmt::format("--window-size={},900", width), "--virtual-time-budget=5000", "--dump-dom",
                     "file://" + path("checked.html")},
                    {120.0, 0, folder_.string()});
    EXPECT_EQ(result.status, 0) << result.err;
    const std::string begin = "data-verdict=\"";
    const size_t at = result.out.find(begin);
    if (at == std::string::npos) return "the page did not come to its check\n" + result.err;
    const size_t from = at + begin.size();
    return result.out.substr(from, result.out.find('"', from) - from);
  }
};

TEST_F(VpmPage, HoldsTheResultsAndFetchesNothing) {
  const std::string page = read("out/report.html");
  const std::string begin = "<script type=\"application/json\" id=\"results\">";
  const size_t from = page.find(begin) + begin.size();
  EXPECT_EQ(json::parse(page.substr(from, page.find("</script>", from) - from)), report("out/results.json"));
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  for (const char* word : {" src=", "<link", "@import", "url("}) EXPECT_EQ(page.find(word), std::string::npos) << word;
  EXPECT_NE(page.find("Released under the MIT License"), std::string::npos);
}

TEST_F(VpmPage, DoesInABrowserWhatItSays) {
  const std::optional<std::string> browser = chromium();
  if (!browser) GTEST_SKIP() << "there is no Chromium here";
  write_checked_page(7, 5);
  for (const int width : {1000, 500}) EXPECT_EQ(verdict(*browser, width), "passed") << width << " pixels wide";
}

}  // namespace
}  // namespace vpm
