// The page of a comparison: what is in the file, what a browser makes of it, how it looks on screens and on paper.
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <optional>
#include <set>
#include <sstream>

#include "tools/ball_of_fog.h"
#include "tools/vpm_binary.h"
#include "vpm/image/exr.h"
#include "vpm/image/metrics.h"
#include "vpm/image/png.h"

namespace vpm {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kPageWidth = 12, kPageHeight = 8;
constexpr int kScreenWidth = 1000, kScreenHeight = 2500;  // pixels

/// Colours that a reader's system prefers, as Chromium numbers them.
enum class Scheme { dark, light };

const std::string kPageScene = "# </script><script>fail('a scene\\'s text is no script')</script>\n" +
                               ball_of_fog(kPageWidth, kPageHeight) + "[volume]\nboundary = \"none\"\n";

/// Two scenes and three methods, some of them biased beside another; one keeps what its techniques find. What texts
/// mean in HTML, and the names of places in the template, mean nothing here.
constexpr const char* kExperiment = R"(
title = "Kernels </script><script>fail('a title is no script')</script> &amp; @about@ \"é\""
unit = "passes"
budgets = [1, 2, 4]
repetitions = 10
baseline = "0.2"
[product]
volume.radius = [0.2, 0.4]
[[methods]]
name = "all"
[methods.set]
render.integrator = "combined"
combined.layers = true
volume.radius = 0.6
[[scenes]]
name = "known"
file = "fog.toml"
reference = "known.exr"
[[scenes]]
name = "again"
file = "fog.toml"
reference = "known.exr"
)";

/// A picture whose every value is another. It is so bright that the method with the least variance has not the least
/// error.
Image known_picture() {
  Image image(kPageWidth, kPageHeight);
  for (size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = Rgb(0.001f, 0.0013f, 0.0017f) * (60.0f + static_cast<float>(i));
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

double mean_luminance(const Image& image) {
  double sum = 0.0;
  for (const Rgb& pixel : image.pixels) sum += luminance(pixel);
  return sum / static_cast<double>(image.pixels.size());
}

size_t count_of_colours(const Image& image) {
  std::set<std::array<float, 3>> colours;
  for (const Rgb& pixel : image.pixels) colours.insert({pixel.r, pixel.g, pixel.b});
  return colours.size();
}

int count_of(const std::string& text, const std::string& what) {
  int count = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

class VpmPage : public VpmBinary {
 protected:
  VpmPage() {
    write("fog.toml", kPageScene);
    write("experiment.toml", kExperiment);
    write_exr(path("known.exr"), known_picture(), {}, {});
    vpm_succeeds({"compare", "experiment.toml", "-o", "out"});
  }

  /// The page with what checks it: what comes first catches errors, what comes last asks questions about a pixel.
  void write_checked_page(int x, int y, Scheme scheme) const {
    std::string page = read("out/report.html");
    const Rgb value = known_picture().at(x, y);
    const json pixel{{"x", x}, {"y", y}, {"value", {value.r, value.g, value.b}}};
    const fs::path folder = fs::path(VPM_SOURCE_DIR) / "tests/tools";
    replace(page, "<style>", fmt::format("<script>\n{}</script>\n<style>", file_text(folder / "page_errors.js")));
    replace(
        page, "</body>",
        fmt::format("<script>\nconst kPixel = {}, kDark = {};\n{}{}</script>\n</body>", pixel.dump(),
                    scheme == Scheme::dark, file_text(folder / "page_looks.js"), file_text(folder / "page_check.js")));
    write("checked.html", page);
  }

  /// What a browser says of a page after it did with it what `action` is called, for a reader whose system has that
  /// scheme of colours.
  ProcessResult browse(const std::string& browser, const std::string& page, const std::string& action, Scheme scheme,
                       int width, int height) const {
    ProcessResult result =
        run_program({browser, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                     "--user-data-dir=" + path("profile"), fmt::format("--window-size={},{}", width, height),
                     fmt::format("--blink-settings=preferredColorScheme={}", static_cast<int>(scheme)),
                     "--virtual-time-budget=5000", action, "file://" + path(page)},
                    {120.0, 0, folder_.string()});
    EXPECT_EQ(result.status, 0) << result.err;
    return result;
  }

  /// What the page says of itself in a window of that width, pixels.
  std::string verdict(const std::string& browser, Scheme scheme, int width) const {
    write_checked_page(7, 5, scheme);
    const ProcessResult result = browse(browser, "checked.html", "--dump-dom", scheme, width, 900);
    const std::string begin = "data-verdict=\"";
    const size_t at = result.out.find(begin);
    if (at == std::string::npos) return "the page did not come to its check\n" + result.err;
    const size_t from = at + begin.size();
    return result.out.substr(from, result.out.find('"', from) - from);
  }

  Image screenshot(const std::string& browser, Scheme scheme) const {
    browse(browser, "out/report.html", "--screenshot=" + path("page.png"), scheme, kScreenWidth, kScreenHeight);
    return read_png(path("page.png"), PngValues::srgb);
  }
};

/// What a page has in the place of that name.
json data_of(const std::string& page, const std::string& place) {
  const std::string begin = "<script type=\"application/json\" id=\"" + place + "\">";
  const size_t from = page.find(begin) + begin.size();
  return json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST_F(VpmPage, HoldsTheResultsAndFetchesNothing) {
  const std::string page = read("out/report.html");
  EXPECT_EQ(data_of(page, "results"), report("out/results.json"));
  for (const json& scene : data_of(page, "pictures"))
    EXPECT_EQ(scene.at("pictures").size(), 1u + 3u + 3u + 6u) << "reference, methods, their means, techniques";
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  for (const char* word : {" src=", "<link", "@import", "url("}) EXPECT_EQ(page.find(word), std::string::npos) << word;
  EXPECT_NE(page.find("Released under the MIT License"), std::string::npos);
}

TEST_F(VpmPage, DoesInABrowserWhatItSays) {
  const std::optional<std::string> browser = chromium();
  if (!browser) GTEST_SKIP() << "there is no Chromium here";
  EXPECT_EQ(verdict(*browser, Scheme::light, 1000), "passed");
  EXPECT_EQ(verdict(*browser, Scheme::dark, 500), "passed");
}

TEST_F(VpmPage, IsLightOrDarkAsItsReaderHasIt) {
  const std::optional<std::string> browser = chromium();
  if (!browser) GTEST_SKIP() << "there is no Chromium here";
  const Image light = screenshot(*browser, Scheme::light), dark = screenshot(*browser, Scheme::dark);
  for (const Image& image : {light, dark}) {
    EXPECT_EQ(image.width, kScreenWidth);
    EXPECT_EQ(image.height, kScreenHeight);
    EXPECT_GT(count_of_colours(image), 200);
  }
  EXPECT_GT(mean_luminance(light), 0.7);
  EXPECT_LT(mean_luminance(dark), 0.1);
}

TEST_F(VpmPage, PrintsItsPlots) {
  const std::optional<std::string> browser = chromium();
  if (!browser) GTEST_SKIP() << "there is no Chromium here";
  browse(*browser, "out/report.html", "--print-to-pdf=" + path("page.pdf"), Scheme::dark, 1000, 900);
  const std::string pdf = read("page.pdf");
  ASSERT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_GE(count_of(pdf, "/Type /Page\n"), 3) << "two scenes and what is about all";
  for (const char* plot : {"relative MSE against", "efficiency over that of the best of", "bias of the mean radiance"})
    EXPECT_EQ(count_of(pdf, fmt::format("/Alt ({}", plot)), 2) << plot;
}

}  // namespace
}  // namespace vpm
