// vpm error as its users meet it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tools/vpm_binary.h"
#include "vpm/base/rng.h"
#include "vpm/image/exr.h"
#include "vpm/image/metrics.h"
#include "vpm/image/statistics_of.h"

namespace vpm {
namespace {

using Json = nlohmann::json;

class VpmError : public VpmBinary {
 protected:
  /// A reference of 3 x 2 pixels, and a picture that is off it in two of them.
  VpmError() : reference_(3, 2), image_(3, 2) {
    for (size_t i = 0; i < reference_.pixels.size(); ++i)
      reference_.pixels[i] = Rgb(1.0f, 0.5f * static_cast<float>(i + 1), 2.0f);
    image_ = reference_;
    image_.at(2, 1).g += 1.5f;
    image_.at(0, 1).r -= 0.25f;
    write_exr(path("image.exr"), image_, {}, {});
    write_exr(path("reference.exr"), reference_, {}, {});
  }
  Json json(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "error");
    arguments.emplace_back("--json");
    return Json::parse(vpm_succeeds(arguments).out);
  }
  /// The reference with an error of that size in its first pixel, made of so many passes.
  void write_member(const std::string& name, float off, const std::string& passes) const {
    Image image = reference_;
    image.pixels[0].b += off;
    write_exr(path(name), image, {}, {{"vpm.passes", passes}});
  }

  Image reference_, image_;
};

TEST_F(VpmError, GivesTheLibrarysNumbers) {
  const Json report = json({"image.exr", "reference.exr"});
  EXPECT_EQ(report.at("width"), 3);
  EXPECT_EQ(report.at("height"), 2);
  EXPECT_DOUBLE_EQ(report.at("mse").at("value"), (1.5 * 1.5 + 0.25 * 0.25) / 18.0);
  EXPECT_DOUBLE_EQ(report.at("relative_mse").at("value"), relative_mse(image_, reference_));
  EXPECT_DOUBLE_EQ(report.at("relative_mse_of_pbrt").at("value"), relative_mse_of_pbrt(image_, reference_));
  EXPECT_EQ(report.at("relative_mse").at("is"), "mean of (I - R)^2 / (R^2 + 0.01 mean(R)^2), mean(R) over the channel");
  EXPECT_NEAR(report.at("means").at("difference")[0], -0.25 / 6.0, 1e-12);
  EXPECT_NEAR(report.at("means").at("difference")[1], 1.5 / 6.0, 1e-12);
  EXPECT_NEAR(report.at("means").at("reference")[2], 2.0, 1e-12);
  const Json& worst = report.at("worst_pixels");
  ASSERT_EQ(worst.size(), 5u);
  EXPECT_EQ(worst[0].at("x"), 2);
  EXPECT_EQ(worst[0].at("y"), 1);
  EXPECT_EQ(worst[0].at("image")[1], 4.5);
  EXPECT_EQ(worst[1].at("x"), 0);
  EXPECT_EQ(worst[1].at("y"), 1);
  EXPECT_EQ(worst[2].at("relative_square"), 0.0);
  EXPECT_EQ(json({"image.exr", "reference.exr", "--worst", "1"}).at("worst_pixels").size(), 1u);
}

TEST_F(VpmError, IsNothingBetweenEqualPictures) {
  const Json report = json({"image.exr", "image.exr"});
  for (const char* error : {"mse", "relative_mse", "relative_mse_of_pbrt"})
    EXPECT_EQ(report.at(error).at("value"), 0.0) << error;
}

TEST_F(VpmError, PrintsForPeople) {
  const std::string text = vpm_succeeds({"error", "image.exr", "reference.exr"}).out;
  for (const char* word : {"3 x 2 pixels", "MSE", "relMSE", "0.01 mean(R)^2", "(R + 0.01)^2", "red", "worst pixels"})
    EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
  EXPECT_EQ(files(), (std::vector<std::string>{"image.exr", "reference.exr"}));
}

TEST_F(VpmError, TellsWhatOfTheErrorIsNoise) {
  Image variance(3, 2);
  for (Rgb& pixel : variance.pixels) pixel = Rgb(0.01f);
  write_exr(path("noisy.exr"), image_, {{"variance", &variance}}, {{"vpm.varianceOfMeans", "4e-4 1e-4 9e-4"}});
  Json report = json({"noisy.exr", "reference.exr"});
  const double found = report.at("relative_mse").at("value"), noise = report.at("relative_mse").at("noise");
  EXPECT_GT(noise, 0.0);
  EXPECT_DOUBLE_EQ(report.at("relative_mse").at("less_noise"), found - noise);
  EXPECT_TRUE(report.at("relative_mse").at("noise_of_reference").is_null());
  EXPECT_EQ(report.at("means").at("standard_error_of_difference"), Json::array({0.02, 0.01, 0.03}));
  EXPECT_FALSE(report.at("means").at("standard_error_knows_correlation"));
  for (Rgb& pixel : variance.pixels) pixel = Rgb(0.04f);
  write_exr(path("noisier.exr"), reference_, {{"variance", &variance}}, {{"vpm.varianceOfMeans", "0 0 0"}});
  const std::string text = vpm_succeeds({"error", "noisy.exr", "noisier.exr"}).out;
  EXPECT_NE(text.find("less noise"), std::string::npos) << text;
  EXPECT_NE(text.find("the reference is noisier than the picture"), std::string::npos) << text;
  EXPECT_TRUE(json({"noisy.exr", "noisier.exr"}).at("means").at("standard_error_knows_correlation"));
}

/// Pictures with statistics, that OpenImageIO's tools change; skipped without them.
class VpmErrorOfChanged : public VpmError {
 protected:
  VpmErrorOfChanged() {
    const Image radiance = noise(1), variance = noise(2);
    write_exr(path("whole.exr"), radiance, {{"variance", &variance}},
              {{"vpm.version", "1"}, {kStatisticsOf, key_of_statistics(radiance, variance)}});
  }
  static Image noise(uint64_t index) {
    Rng rng(7, rng_stream(RngUse::test, 0), index);
    Image image(64, 48);
    for (Rgb& pixel : image.pixels) pixel = Rgb(rng.uniform(), rng.uniform(), rng.uniform());
    return image;
  }
  /// oiiotool whole.exr, what is asked for, and changed.exr: false where there is none of it.
  bool change(const std::string& by) const {
    const std::string line = "oiiotool '" + path("whole.exr") + "' " + by + " '" + path("changed.exr") + "'";
    return run_program({"/bin/sh", "-c", "command -v oiiotool > /dev/null && " + line}).status == 0;
  }
  /// What the warning about the statistics of the changed picture says.
  std::string told(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"error", "changed.exr", "whole.exr"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const std::string said = vpm_succeeds(arguments).err;
    const std::string begins = "warning: changed.exr: its layers of statistics are not used: ";
    return said.starts_with(begins) ? said.substr(begins.size()) : said;
  }
};

TEST_F(VpmErrorOfChanged, StatisticsThatNoLongerFitAreLeftOut) {
  if (!change("-o")) GTEST_SKIP() << "there is no oiiotool";
  EXPECT_EQ(told(), "") << "a copy without loss";
  const std::string changed = "the picture's values were changed since they were made\n";
  ASSERT_TRUE(change("--compression piz -o"));
  EXPECT_EQ(told(), "");
  ASSERT_TRUE(change("--compression dwaa:45 -o"));
  EXPECT_EQ(told(), changed);
  ASSERT_TRUE(change("-d half -o"));
  EXPECT_EQ(told(), changed);
  ASSERT_TRUE(change("--mulc 2 -o"));
  EXPECT_EQ(told(), changed);
  ASSERT_TRUE(
      change("--ch R,R,B,A,variance.R,variance.G,variance.B --chnames R,G,B,A,variance.R,variance.G,variance.B -o"));
  EXPECT_EQ(told(), changed) << "of other colours";
  ASSERT_TRUE(change("-d half -d R=float -d G=float -d B=float -o"));
  EXPECT_EQ(told(), "they were changed since then\n");
  ASSERT_TRUE(change("--resize 32x24 -o"));
  EXPECT_EQ(told({"--resample"}), "they were made for 64 x 48 pixels, and the picture has 32 x 24\n");
}

TEST_F(VpmErrorOfChanged, StatisticsWithoutAKeyAreBelieved) {
  const Image radiance = noise(1), variance = noise(2);
  write_exr(path("changed.exr"), radiance, {{"variance", &variance}}, {{"vpm.version", "1"}});
  EXPECT_EQ(told(),
            "note: changed.exr: it does not say for which pixels its variances were made; they are taken for its "
            "own\n");
}

/// Layers by name, of the picture and of the reference.
TEST_F(VpmErrorOfChanged, ComparesTheLayersThatAreNamed) {
  const Json both = json({"whole.exr", "whole.exr", "--layer", "variance", "--reference-layer", "variance"});
  EXPECT_EQ(both.at("mse").at("value"), 0.0);
  EXPECT_EQ(both.at("reference_layer"), "variance");
  EXPECT_NE(vpm_succeeds({"error", "whole.exr", "whole.exr", "--layer", "variance"})
                .out.find("whole.exr (I, layer variance) against whole.exr (R), "),
            std::string::npos);
  EXPECT_GT(json({"whole.exr", "whole.exr", "--layer", "variance"}).at("mse").at("value"), 0.1);
  vpm_refuses({"error", "whole.exr", "whole.exr", "--layer", "depth"}, {"whole.exr", "'depth'", "variance"});
}

TEST_F(VpmError, BringsAPictureToTheSizeOfTheReference) {
  write_exr(path("large.exr"), Image(6, 4), {}, {});
  vpm_refuses({"error", "large.exr", "reference.exr"}, {"6 x 4", "3 x 2", "--size 3x2", "--resample"});
  EXPECT_EQ(json({"large.exr", "reference.exr", "--resample"}).at("width"), 3);
  write_exr(path("nearly.exr"), Image(14, 10), {}, {});  // 3 : 2, but for rounding
  EXPECT_EQ(json({"nearly.exr", "reference.exr", "--resample"}).at("height"), 2);
  write_exr(path("square.exr"), Image(60, 60), {}, {});
  vpm_refuses({"error", "square.exr", "reference.exr", "--resample"}, {"60 x 60", "3 x 2", "different shapes"});
}

TEST_F(VpmError, SaysThatPicturesShareNoise) {
  const auto write = [&](const std::string& name, const std::string& seed, const std::string& integrator) {
    write_exr(path(name), image_, {}, {{"vpm.seed", seed}, {"vpm.settings", "integrator.type=" + integrator + " x=1"}});
  };
  write("one.exr", "1", "photon-map");
  write("again.exr", "1", "photon-map");
  write("two.exr", "2", "photon-map");
  write("paths.exr", "1", "path");
  EXPECT_TRUE(json({"one.exr", "again.exr"}).at("same_seed"));
  for (const char* other : {"two.exr", "paths.exr", "image.exr"})
    EXPECT_FALSE(json({"one.exr", other}).at("same_seed")) << other;
  EXPECT_FALSE(json({"image.exr", "reference.exr"}).at("same_seed"));  // neither tells
  Image variance(3, 2);
  for (Rgb& pixel : variance.pixels) pixel = Rgb(0.01f);
  for (const char* name : {"noisy.exr", "as_noisy.exr"})
    write_exr(path(name), image_, {{"variance", &variance}}, {{"vpm.seed", "7"}, {"vpm.settings", "x=1"}});
  const std::string text = vpm_succeeds({"error", "noisy.exr", "as_noisy.exr"}).out;
  EXPECT_NE(text.find("of the same seed"), std::string::npos) << text;
}

TEST_F(VpmError, WritesTheSignedDifference) {
  vpm_succeeds({"error", "image.exr", "reference.exr", "-o", "off.exr"});
  const Image off = read_exr(path("off.exr"));
  EXPECT_EQ(off.at(2, 1), Rgb(0.0f, 1.5f, 0.0f));
  EXPECT_EQ(off.at(0, 1), Rgb(-0.25f, 0.0f, 0.0f));
  EXPECT_EQ(off.at(1, 0), Rgb(0.0f));
  const auto metadata = read_exr_channels(path("off.exr")).metadata;
  EXPECT_EQ(metadata.at("vpm.image"), "image.exr");
  EXPECT_EQ(metadata.at("vpm.reference"), "reference.exr");
}

TEST_F(VpmError, FitsHowASeriesConverges) {
  // Errors that fall exactly as one over the passes.
  for (const int passes : {1, 4, 16})
    write_member(std::to_string(passes) + ".exr", 1.0f / std::sqrt(static_cast<float>(passes)), std::to_string(passes));
  const Json report = json({"--series", "1.exr", "4.exr", "16.exr", "reference.exr"});
  ASSERT_EQ(report.at("series").size(), 3u);
  EXPECT_EQ(report.at("series")[1].at("passes"), 4);
  EXPECT_DOUBLE_EQ(report.at("series")[1].at("mse"), 0.25 / 18.0);
  for (const char* error : {"mse", "relative_mse"}) {
    EXPECT_NEAR(report.at("over_passes").at(error).at("slope"), -1.0, 1e-12) << error;
    EXPECT_NEAR(report.at("over_passes").at(error).at("standard_error"), 0.0, 1e-12) << error;
  }
  const std::string text = vpm_succeeds({"error", "--series", "1.exr", "4.exr", "16.exr", "reference.exr"}).out;
  for (const char* word : {"against reference.exr", "16.exr", "relMSE goes as passes^-1.000"})
    EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
}

// A reference whose noise is as large as its variance, in other pixels than the error, which falls as one over passes.
TEST_F(VpmError, TakesTheReferencesNoiseOffASeries) {
  for (const int passes : {1, 4, 16})
    write_member(std::to_string(passes) + ".exr", 1.0f / std::sqrt(static_cast<float>(passes)), std::to_string(passes));
  Image variance(3, 2);
  for (size_t i = 1; i < variance.pixels.size(); ++i) {
    variance.pixels[i] = Rgb(0.04f);
    reference_.pixels[i] += Rgb(0.2f, -0.2f, 0.2f);
  }
  write_exr(path("noisy.exr"), reference_, {{"variance", &variance}}, {});
  const Json report = json({"--series", "1.exr", "4.exr", "16.exr", "noisy.exr"});
  EXPECT_NEAR(report.at("noise_of_reference").at("mse").get<double>(), 0.04 * 5 / 6, 1e-8);
  for (const char* error : {"mse", "relative_mse"})
    EXPECT_NEAR(report.at("over_passes").at(error).at("slope").get<double>(), -1.0, 1e-4) << error;
  EXPECT_TRUE(json({"--series", "1.exr", "reference.exr"}).at("noise_of_reference").at("mse").is_null());
  const std::string text = vpm_succeeds({"error", "--series", "1.exr", "4.exr", "16.exr", "noisy.exr"}).out;
  EXPECT_NE(text.find("are noise of the reference"), std::string::npos) << text;
}

TEST_F(VpmError, SaysWhyASeriesHasNoSlope) {
  write_member("a.exr", 1.0f, "2");
  write_member("b.exr", 0.5f, "2");
  write_member("c.exr", 0.5f, "two");
  const auto said = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"error", "--series"});
    arguments.emplace_back("reference.exr");
    return vpm_succeeds(arguments).out;
  };
  EXPECT_NE(said({"a.exr", "image.exr"}).find("image.exr does not state its passes"), std::string::npos);
  EXPECT_NE(said({"a.exr", "c.exr"}).find("c.exr does not state its passes"), std::string::npos);
  EXPECT_NE(said({"a.exr", "b.exr"}).find("the same number of passes"), std::string::npos);
  EXPECT_NE(said({"a.exr"}).find("the same number of passes"), std::string::npos);
  write_exr(path("other.exr"), image_, {}, {{"vpm.passes", "8"}, {"vpm.sceneHash", "1234"}});
  EXPECT_NE(said({"a.exr", "other.exr"}).find("other.exr has another scene or other settings than a.exr"),
            std::string::npos);
  write_member("exact.exr", 0.0f, "8");
  EXPECT_NE(said({"a.exr", "exact.exr"}).find("the error of exact.exr is 0"), std::string::npos);
}

TEST_F(VpmError, SaysThatPixelsAreNotFinite) {
  image_.at(1, 1).r = std::numeric_limits<float>::quiet_NaN();
  write_exr(path("broken.exr"), image_, {}, {});
  const ProcessResult result = vpm_succeeds({"error", "broken.exr", "reference.exr", "--json"});
  EXPECT_NE(result.err.find("broken.exr: 1 of its pixels are not finite"), std::string::npos) << result.err;
  const Json report = Json::parse(result.out);
  EXPECT_EQ(report.at("mse").at("value"), "nan");
  EXPECT_EQ(report.at("non_finite_pixels").at("image"), 1);
  EXPECT_EQ(report.at("worst_pixels")[0].at("x"), 1);
  EXPECT_EQ(report.at("worst_pixels")[0].at("y"), 1);
}

TEST_F(VpmError, RefusesWhatItCannotCompare) {
  write_exr(path("small.exr"), Image(2, 2), {}, {});
  write("text.exr", "no picture");
  vpm_refuses({"error", "small.exr", "reference.exr"},
              {"small.exr has 2 x 2", "reference.exr has 3 x 2", "--resample"});
  vpm_refuses({"error", "--series", "image.exr", "small.exr", "reference.exr"}, {"small.exr has 2 x 2", "--resample"});
  vpm_refuses({"error", "text.exr", "reference.exr"}, {"text.exr"});
  vpm_refuses({"error", "image.exr", "missing.exr"}, {"missing.exr", "no such file"});
  vpm_refuses({"error", "image.exr"}, {"two pictures", "not 1", "--series"});
  vpm_refuses({"error", "image.exr", "image.exr", "reference.exr"}, {"two pictures", "not 3", "--series"});
  vpm_refuses({"error", "--series", "reference.exr"}, {"a series is"});
  vpm_refuses({"error"}, {"images"});
  vpm_refuses({"error", "image.exr", "reference.exr", "-o", "off.png"}, {"off.png", ".exr"});
  vpm_refuses({"error", "image.exr", "reference.exr", "-o", "image.exr"}, {"image.exr", "one of the pictures"});
  vpm_refuses({"error", "image.exr", "reference.exr", "-o", "missing/off.exr"}, {"missing/off.exr"});
  vpm_refuses({"error", "--series", "image.exr", "reference.exr", "-o", "off.exr"}, {"--series", "--output"});
  vpm_refuses({"error", "image.exr", "reference.exr", "--worst", "-1"}, {"--worst"});
}

}  // namespace
}  // namespace vpm
