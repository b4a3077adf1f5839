// Pages that vpm writes, as a browser shows them.
#pragma once

#include <fmt/format.h>

#include <array>
#include <optional>
#include <set>

#include "tools/vpm_binary.h"
#include "vpm/image/image.h"
#include "vpm/image/metrics.h"
#include "vpm/image/png.h"

namespace vpm {

/// Colours that a reader's system prefers, as Chromium numbers them.
enum class Scheme { dark, light };

/// A browser, where there is one.
inline std::optional<std::string> chromium() {
  return program_in_path({"chromium", "chromium-browser", "google-chrome"});
}

/// What a page has in the element of that name.
inline nlohmann::json data_of(const std::string& page, const std::string& place) {
  const std::string begin = "<script type=\"application/json\" id=\"" + place + "\">";
  const size_t from = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

inline double mean_luminance(const Image& image) {
  double sum = 0.0;
  for (const Rgb& pixel : image.pixels) sum += luminance(pixel);
  return sum / static_cast<double>(image.pixels.size());
}

inline size_t count_of_colours(const Image& image) {
  std::set<std::array<float, 3>> colours;
  for (const Rgb& pixel : image.pixels) colours.insert({pixel.r, pixel.g, pixel.b});
  return colours.size();
}

class BrowsedPage : public VpmBinary {
 protected:
  static constexpr int kScreenWidth = 1000, kScreenHeight = 2500;  // pixels

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

  /// What a page says of itself in a window of that width, pixels, with what checks it: what comes first catches
  /// errors, what comes last are scripts of this folder, which know `constants`.
  std::string verdict(const std::string& browser, const std::string& page, const nlohmann::json& constants,
                      std::vector<std::string> scripts, Scheme scheme, int width) const {
    std::string checked = read(page), checks = fmt::format("const kDark = {};\n", scheme == Scheme::dark);
    for (const auto& [name, value] : constants.items()) checks += fmt::format("const {} = {};\n", name, value.dump());
    scripts.insert(scripts.begin(), "page_use.js");
    for (const std::string& script : scripts) checks += script_text(script);
    replace(checked, "<style>", fmt::format("<script>\n{}</script>\n<style>", script_text("page_errors.js")));
    replace(checked, "</body>", fmt::format("<script>\n{}</script>\n</body>", checks));
    write("checked.html", checked);
    const ProcessResult result = browse(browser, "checked.html", "--dump-dom", scheme, width, 900);
    const std::string begin = "data-verdict=\"";
    const size_t at = result.out.find(begin);
    if (at == std::string::npos) return "the page did not come to its check\n" + result.err;
    const size_t from = at + begin.size();
    return result.out.substr(from, result.out.find('"', from) - from);
  }

  /// The page fills a screen with many colours, light or dark ones.
  void looks_as_preferred(const std::string& browser, const std::string& page) const {
    for (const Scheme scheme : {Scheme::light, Scheme::dark}) {
      browse(browser, page, "--screenshot=" + path("page.png"), scheme, kScreenWidth, kScreenHeight);
      const Image image = read_png(path("page.png"), PngValues::srgb);
      EXPECT_EQ(image.width, kScreenWidth);
      EXPECT_EQ(image.height, kScreenHeight);
      EXPECT_GT(count_of_colours(image), 200);
      if (scheme == Scheme::light)
        EXPECT_GT(mean_luminance(image), 0.7);
      else
        EXPECT_LT(mean_luminance(image), 0.1);
    }
  }

  /// A page that holds all it shows.
  void fetches_nothing(const std::string& page) const {
    EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
    for (const char* word : {" src=", "<link", "@import", "url("})
      EXPECT_EQ(page.find(word), std::string::npos) << word;
  }

 private:
  static std::string script_text(const std::string& name) {
    std::ifstream file(std::filesystem::path(VPM_SOURCE_DIR) / "tests/tools" / name, std::ios::binary);
    EXPECT_TRUE(file) << name;
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static void replace(std::string& text, const std::string& what, const std::string& by) {
    const size_t at = text.rfind(what);
    ASSERT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), by);
  }
};

}  // namespace vpm
