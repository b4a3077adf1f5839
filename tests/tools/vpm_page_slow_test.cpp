// The page of a comparison: what is in the file, what a browser makes of it, how it looks on screens and on paper.
#include <fmt/format.h>

#include "tools/ball_of_fog.h"
#include "tools/browser.h"
#include "vpm/image/exr.h"

namespace vpm {
namespace {

using nlohmann::json;

constexpr int kPageWidth = 12, kPageHeight = 8;

const std::string kPageScene = "# </script><script>fail('a scene\\'s text is no script')</script>\n" +
                               ball_of_fog(kPageWidth, kPageHeight) + "[integrator.volume]\nboundary = \"none\"\n";

/// Two scenes and three methods, some of them biased beside another; one keeps what its techniques find. What texts
/// mean in HTML, and the names of places in the template, mean nothing here.
constexpr const char* kExperiment = R"(
title = "Kernels </script><script>fail('a title is no script')</script> &amp; @about@ \"é\""
unit = "passes"
budgets = [1, 2, 4]
repetitions = 10
baseline = "0.2"
[product]
integrator.volume.radius = [0.2, 0.4]
[[methods]]
name = "all"
[methods.set]
integrator.type = "combined"
integrator.layers = true
integrator.volume.radius = 0.6
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

int count_of(const std::string& text, const std::string& what) {
  int count = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

class VpmPage : public BrowsedPage {
 protected:
  VpmPage() {
    write("fog.toml", kPageScene);
    write("experiment.toml", kExperiment);
    write_exr(path("known.exr"), known_picture(), {}, {});
    vpm_succeeds({"compare", "experiment.toml", "-o", "out"});
  }

  /// What the page says of itself in a window of that width, pixels.
  std::string verdict(const std::string& browser, Scheme scheme, int width) const {
    constexpr int kX = 7, kY = 5;
    const Rgb value = known_picture().at(kX, kY);
    const json pixel{{"x", kX}, {"y", kY}, {"value", {value.r, value.g, value.b}}};
    return BrowsedPage::verdict(browser, "out/report.html", {{"kPixel", pixel}}, {"page_looks.js", "page_check.js"},
                                scheme, width);
  }
};

TEST_F(VpmPage, HoldsTheResultsAndFetchesNothing) {
  const std::string page = read("out/report.html");
  EXPECT_EQ(data_of(page, "results"), report("out/results.json"));
  for (const json& scene : data_of(page, "pictures"))
    EXPECT_EQ(scene.at("pictures").size(), 1u + 3u + 3u + 6u) << "reference, methods, their means, techniques";
  fetches_nothing(page);
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
  looks_as_preferred(*browser, "out/report.html");
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
