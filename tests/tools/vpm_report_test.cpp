// vpm report: what its page holds, and what it refuses.
#include <cmath>

#include "tools/rendered_fog.h"
#include "vpm/image/exr.h"
#include "vpm/image/image.h"

namespace vpm {
namespace {

using nlohmann::json;

std::vector<uint8_t> bytes_of_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<uint8_t> bytes;
  uint32_t group = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    group = group << 6 | static_cast<uint32_t>(text[i] == '=' ? 0 : digits.find(text[i]));
    if (i % 4 == 3)
      for (const int shift : {16, 8, 0}) bytes.push_back(static_cast<uint8_t>(group >> shift));
  }
  return bytes;
}

/// [IEEE2019, sec. 3.4, binary16], of finite numbers.
float value_of_half(int bits) {
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  const float size = exponent > 0 ? std::ldexp(static_cast<float>(1024 + fraction), exponent - 25)
                                  : std::ldexp(static_cast<float>(fraction), -24);
  return bits & 0x8000 ? -size : size;
}

/// The picture of a page, as its reader sees it.
Image decoded(const json& pictures, size_t i) {
  const json& picture = pictures.at("pictures").at(i);
  const std::vector<uint8_t> bytes = bytes_of_base64(picture.at("halves"));
  Image image(pictures.at("width"), pictures.at("height"));
  EXPECT_GE(bytes.size(), 6 * image.pixels.size());
  for (size_t p = 0; p < image.pixels.size(); ++p)
    for (int c = 0; c < 3; ++c) {
      const size_t at = 2 * (3 * p + static_cast<size_t>(c));
      image.pixels[p][c] = std::ldexp(value_of_half(bytes[at] | bytes[at + 1] << 8), picture.at("exponent"));
    }
  return image;
}

float largest_value(const Image& image) {
  float largest = 0.0f;
  for (const Rgb& pixel : image.pixels)
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(pixel[c]));
  return largest;
}

/// A half has 11 bits, over eight decades.
void expect_same_halves(const Image& shown, const Image& image, const std::string& what) {
  ASSERT_EQ(shown.pixels.size(), image.pixels.size()) << what;
  const float largest = largest_value(image);
  for (size_t p = 0; p < image.pixels.size(); ++p)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(shown.pixels[p][c], image.pixels[p][c], std::abs(image.pixels[p][c]) * 0x1p-11f + largest * 1e-8f)
          << what << ", pixel " << p;
}

using VpmReport = RenderedFog;

TEST_F(VpmReport, HoldsTheReportAndFetchesNothing) {
  const ProcessResult told = vpm_succeeds({"report", "fog.json"});
  EXPECT_NE(told.out.find("fog.html: "), std::string::npos);
  EXPECT_NE(told.out.find(" MB"), std::string::npos);
  const std::string page = read("fog.html");
  fetches_nothing(page);
  EXPECT_EQ(data_of(page, "data").at("report"), report("fog.json"));
}

TEST_F(VpmReport, HoldsThePixelsOfThePicture) {
  vpm_succeeds({"report", "fog.json", "-o", "page.html"});
  const json pictures = data_of(read("page.html"), "pictures");
  const ExrChannels file = read_exr_channels(path("fog.exr"));
  EXPECT_EQ(pictures.at("block"), 1);
  std::vector<std::string> names;
  for (size_t i = 0; i < pictures.at("pictures").size(); ++i) {
    const std::string name = pictures["pictures"][i].at("name");
    names.push_back(name);
    const std::string layer = name == "radiance"         ? ""
                              : name == "standard error" ? "variance"
                              : name == "bias"           ? name
                                                         : "combined." + name + ".weighted";
    std::optional<Image> image = layer_of(file, layer);
    ASSERT_TRUE(image) << name;
    if (layer == "variance")
      for (Rgb& pixel : image->pixels)
        for (int c = 0; c < 3; ++c) pixel[c] = std::sqrt(pixel[c]);
    expect_same_halves(decoded(pictures, i), *image, name);
    const bool finds_nothing = name == "surface-merging" || name == "points-3d";
    EXPECT_EQ(largest_value(*image) > 0.0f, !finds_nothing) << name;
  }
  const std::vector<std::string> expected{"radiance",    "standard error", "bias",
                                          "connections", "light-tracing",  "surface-merging",
                                          "points-3d",   "points-2d",      "short-beams"};
  EXPECT_EQ(names, expected);
}

TEST_F(VpmReport, ShowsThePixelsOfACrop) {
  vpm_succeeds({"render", "fog.toml", "-o", "part.exr", "--passes", "1", "--crop", "3,2,9,6"});
  vpm_succeeds({"report", "part.json"});
  const json pictures = data_of(read("part.html"), "pictures");
  EXPECT_EQ(pictures.at("width"), 6);
  EXPECT_EQ(pictures.at("height"), 4);
  expect_same_halves(decoded(pictures, 0), cropped(read_exr(path("part.exr")), {3, 2, 9, 6}), "radiance");
}

/// A scene that vpm view made and did not write has no file to name.
TEST_F(VpmReport, NamesNoCommandsWhereTheSceneIsInNoFile) {
  vpm_succeeds({"media", "smoke", "--resolution", "8", "-o", "smoke.vdb"});
  vpm_succeeds({"view", "smoke.vdb", "--size", "8x8", "--passes", "1"});
  vpm_succeeds({"report", "smoke.json"});
  EXPECT_EQ(data_of(read("smoke.html"), "data").at("commands"), json::array());
  EXPECT_FALSE(data_of((vpm_succeeds({"report", "fog.json"}), read("fog.html")), "data").at("commands").empty());
}

TEST_F(VpmReport, ReducesLargePicturesToMeansOfSquares) {
  constexpr int kLargeWidth = 1101, kLargeHeight = 1000;
  Image large(kLargeWidth, kLargeHeight);
  for (size_t i = 0; i < large.pixels.size(); ++i)
    large.pixels[i] = Rgb(0.1f, 0.2f, 0.3f) * static_cast<float>(1 + i * 7919 % 1000);
  Image variance = large;
  const std::map<std::string, std::string> of_file = read_exr_channels(path("fog.exr")).metadata;
  std::vector<std::pair<std::string, std::string>> metadata;
  for (const auto& [key, value] : of_file)
    if (key.starts_with("vpm.")) metadata.emplace_back(key, value);
  write_exr(path("large.exr"), large, {{"variance", &variance}}, metadata);
  json of_large = report("fog.json");
  of_large["width"] = kLargeWidth;
  of_large["height"] = kLargeHeight;
  of_large["rendered_pixels"] = {{"x0", 0}, {"y0", 0}, {"x1", kLargeWidth}, {"y1", kLargeHeight}};
  write("large.json", of_large.dump());
  vpm_succeeds({"report", "large.json"});
  const json pictures = data_of(read("large.html"), "pictures");
  EXPECT_EQ(pictures.at("block"), 2);
  Image means(551, 500), errors(551, 500);
  for (int y = 0; y < means.height; ++y)
    for (int x = 0; x < means.width; ++x) {
      Rgbd sum(0.0);
      const int across = x == 550 ? 1 : 2;  // the last column is one pixel wide
      for (int v = 0; v < 2; ++v)
        for (int u = 0; u < across; ++u) sum += Rgbd(large.at(2 * x + u, 2 * y + v));
      means.at(x, y) = Rgb(sum / (2.0 * across));
      for (int c = 0; c < 3; ++c) errors.at(x, y)[c] = std::sqrt(means.at(x, y)[c]);
    }
  expect_same_halves(decoded(pictures, 0), means, "radiance");
  expect_same_halves(decoded(pictures, 1), errors, "standard error");
}

TEST_F(VpmReport, TellsSettingsWithDefaultsAndReasons) {
  vpm_succeeds({"report", "fog.json"});
  const json data = data_of(read("fog.html"), "data"), all = report("fog.json");
  EXPECT_EQ(data.at("settings").size(), all.at("settings").size());
  std::map<std::string, json> rows;
  for (const json& row : data.at("settings")) rows[row.at("key")] = row;
  EXPECT_EQ(rows.at("integrator.type").at("value"), "combined");
  EXPECT_EQ(rows.at("integrator.type").at("default"), "`\"photon-map\"`");
  EXPECT_EQ(rows.at("integrator.type").at("is_default"), false);
  EXPECT_TRUE(rows.at("integrator.type").at("reason").is_null());
  EXPECT_EQ(rows.at("integrator.surface.kernel").at("is_default"), true);
  EXPECT_EQ(rows.at("integrator.distance.type").at("is_default"), true) << "that of the integrator";
  EXPECT_EQ(all.at("chosen").at(0).at("key"), "integrator.volume.radius");
  EXPECT_EQ(rows.at("integrator.volume.radius").at("reason"), all.at("chosen").at(0).at("reason"));
  EXPECT_FALSE(rows.at("integrator.volume.radius").at("meaning").get<std::string>().empty());
}

TEST_F(VpmReport, TellsACommandThatRendersTheSamePictureAgain) {
  vpm_succeeds({"report", "fog.json"});
  std::string command = data_of(read("fog.html"), "data").at("commands").at(0).at("command");
  EXPECT_EQ(command.substr(0, 27), "vpm render fog.toml -o fog.");
  EXPECT_EQ(command.find("auto"), std::string::npos) << "what was chosen is to be as it was chosen";
  const ExrChannels first = read_exr_channels(path("fog.exr"));
  std::filesystem::remove(path("fog.exr"));
  command.replace(0, 3, VPM_BINARY);
  const ProcessResult again = run_program({"/bin/sh", "-c", command}, {60.0, 0, folder_.string()});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(read_exr_channels(path("fog.exr")).planes, first.planes);
}

TEST_F(VpmReport, HasTheWarningsOfTheRender) {
  const json warnings = report("fog.json").at("warnings");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].get<std::string>().find("photons were cut at render.max_events"), std::string::npos);
}

TEST_F(VpmReport, RefusesThePictureOfAnotherRender) {
  const std::string text = read("fog.json");
  const auto refuses = [&](const char* key, const json& value, const std::vector<std::string>& words) {
    json changed = json::parse(text);
    changed[json::json_pointer(key)] = value;
    write("fog.json", changed.dump());
    vpm_refuses({"report", "fog.json"}, words);
  };
  refuses("/passes", 8, {"fog.exr", "another render", "vpm.passes is 9 in the picture and 8 in the report"});
  refuses("/seed", 77, {"vpm.seed is 1 in the picture and 77"});
  refuses("/scene_hash", "00", {"vpm.sceneHash"});
  refuses("/settings/integrator.heuristic", "power", {"vpm.settings"});
  refuses("/settings/integrator.heuristic", "none", {"fog.json", "has no setting integrator.heuristic = none"});
  refuses("/settings/volume.of_old", 3, {"fog.json", "has no setting volume.of_old = 3"});
  refuses("/width", 25, {"24 x 8 pixels, not 25 x 8"});
  write("fog.json", text);
  write_exr(path("fog.exr"), Image(kWidth, kHeight), {}, {});
  vpm_refuses({"report", "fog.json"}, {"fog.exr", "no picture of vpm render"});
  write("fog.exr", "damaged");
  vpm_refuses({"report", "fog.json"}, {"fog.exr"});
  std::filesystem::remove(path("fog.exr"));
  vpm_refuses({"report", "fog.json"}, {"fog.json", "picture is missing", "'fog.exr'"});
}

}  // namespace
}  // namespace vpm
