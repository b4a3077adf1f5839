// The page of a render in a browser: used as its reader uses it, light and dark, on paper.
#include <cmath>

#include "tools/rendered_fog.h"
#include "vpm/image/exr.h"

namespace vpm {
namespace {

using nlohmann::json;

class VpmReportPage : public RenderedFog {
 protected:
  VpmReportPage() { vpm_succeeds({"report", "fog.json"}); }

  /// What the page says of itself in a window of that width, pixels.
  std::string verdict(const std::string& browser, Scheme scheme, int width) const {
    constexpr int kX = 12, kY = 3;
    const ExrChannels file = read_exr_channels(path("fog.exr"));
    json pixel{{"x", kX}, {"y", kY}};
    for (const char channel : {'R', 'G', 'B'}) {
      const size_t at = kY * kWidth + kX;
      pixel["radiance"].push_back(file.planes.at({channel})[at]);
      pixel["error"].push_back(std::sqrt(file.planes.at(std::string("variance.") + channel)[at]));
    }
    return BrowsedPage::verdict(browser, "fog.html", {{"kPixel", pixel}}, {"page_looks.js", "report_check.js"}, scheme,
                                width);
  }

  /// A script's verdict on the page of a pass with these options.
  void examine_one_pass(const std::vector<std::string>& options, const std::string& script) const {
    const std::optional<std::string> browser = chromium();
    if (!browser) GTEST_SKIP() << "there is no Chromium here";
    std::vector<std::string> render{"render", "fog.toml", "-o", "one.exr", "--passes", "1"};
    render.insert(render.end(), options.begin(), options.end());
    vpm_succeeds(render);
    vpm_succeeds({"report", "one.json"});
    EXPECT_EQ(BrowsedPage::verdict(*browser, "one.html", json::object(), {script}, Scheme::light, 1000), "passed");
  }
};

TEST_F(VpmReportPage, DoesInABrowserWhatItSays) {
  const std::optional<std::string> browser = chromium();
  if (!browser) GTEST_SKIP() << "there is no Chromium here";
  EXPECT_EQ(verdict(*browser, Scheme::light, 1000), "passed");
  EXPECT_EQ(verdict(*browser, Scheme::dark, 500), "passed");
}

TEST_F(VpmReportPage, ShowsARenderWithoutErrorsAndPhotons) {
  examine_one_pass({"--set", "integrator.type=path"}, "report_of_paths_check.js");
}

/// As pixels of the film, which other commands count, too.
TEST_F(VpmReportPage, NamesThePixelsOfACropByTheirPlaceInTheFilm) {
  examine_one_pass({"--crop", "3,2,9,6"}, "report_of_crop_check.js");
}

TEST_F(VpmReportPage, IsLightOrDarkAsItsReaderHasIt) {
  const std::optional<std::string> browser = chromium();
  if (!browser) GTEST_SKIP() << "there is no Chromium here";
  looks_as_preferred(*browser, "fog.html");
}

}  // namespace
}  // namespace vpm
