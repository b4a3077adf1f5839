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
};

TEST_F(VpmReportPage, DoesInABrowserWhatItSays) {
  const std::optional<std::string> browser = chromium();
  if (!browser) GTEST_SKIP() << "there is no Chromium here";
  EXPECT_EQ(verdict(*browser, Scheme::light, 1000), "passed");
  EXPECT_EQ(verdict(*browser, Scheme::dark, 500), "passed");
}

TEST_F(VpmReportPage, ShowsARenderWithoutErrorsAndPhotons) {
  const std::optional<std::string> browser = chromium();
  if (!browser) GTEST_SKIP() << "there is no Chromium here";
  vpm_succeeds({"render", "fog.toml", "-o", "paths.exr", "--passes", "1", "--set", "render.integrator=path"});
  vpm_succeeds({"report", "paths.json"});
  EXPECT_EQ(
      BrowsedPage::verdict(*browser, "paths.html", json::object(), {"report_of_paths_check.js"}, Scheme::light, 1000),
      "passed");
}

TEST_F(VpmReportPage, IsLightOrDarkAsItsReaderHasIt) {
  const std::optional<std::string> browser = chromium();
  if (!browser) GTEST_SKIP() << "there is no Chromium here";
  looks_as_preferred(*browser, "fog.html");
}

}  // namespace
}  // namespace vpm
