// A grid to a picture in one command, and the options that change what a picture is of.
#include <sstream>

#include "tools/plume.h"
#include "vpm/image/exr.h"
#include "vpm/image/image.h"
#include "vpm/image/metrics.h"
#include "vpm/image/png.h"

namespace vpm {
namespace {

class VpmCrop : public VpmRender, public ::testing::WithParamInterface<const char*> {};

/// The crop begins and ends within tiles, and neither in the first column nor in the first row of these.
TEST_P(VpmCrop, HasTheBitsOfThatPartOfTheWhole) {
  std::vector<std::string> settings{"--set", "integrator.type=" + std::string(GetParam()), "--spp", "2"};
  if (GetParam() == std::string("combined")) settings.insert(settings.end(), {"--layers", "combined"});
  const auto render = [&](const std::string& name, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"render", "scene.toml", "-o", name + ".exr", "--passes", "3"};
    arguments.insert(arguments.end(), settings.begin(), settings.end());
    arguments.insert(arguments.end(), options.begin(), options.end());
    vpm_succeeds(arguments);
  };
  render("whole", {});
  render("part", {"--crop", "18,17,37,23"});
  ExrChannels whole = read_exr_channels(path("whole.exr"));
  const ExrChannels part = read_exr_channels(path("part.exr"));
  ASSERT_EQ(part.width, 40);
  ASSERT_EQ(part.height, 24);
  double sum = 0.0;
  for (const auto& [name, plane] : part.planes) {
    for (size_t i = 0; i < plane.size(); ++i) {
      const size_t x = i % 40, y = i / 40;
      const bool inside = x >= 18 && x < 37 && y >= 17 && y < 23;
      ASSERT_EQ(plane[i], inside ? whole.planes.at(name)[i] : 0.0f) << name << " at " << x << ", " << y;
      sum += double{plane[i]};
    }
  }
  EXPECT_GT(sum, 0.0);
  constexpr int kMet = (40 - 16) * (24 - 16);  // pixels of the tiles of 16 x 16 that it meets, as the film cuts them
  EXPECT_EQ(report("part.json")["eye"]["camera_rays"], kMet * 2 * 3);
  const Image preview = read_png(path("part.png"), PngValues::srgb);
  EXPECT_EQ(preview.width, 19);
  EXPECT_EQ(preview.height, 6);
}
INSTANTIATE_TEST_SUITE_P(Integrators, VpmCrop, ::testing::Values("photon-map", "combined", "path"), [](const auto& of) {
  return std::string(of.param).substr(0, of.param == std::string("photon-map") ? 6 : 8);
});

/// Pixels with radii of their own do not notice, nor does a render that goes on.
TEST_F(VpmRender, ACropWithRadiiPerPixelGoesOn) {
  const std::vector<std::string> common{"--set", "integrator.radii=per-pixel", "--set",
                                        "integrator.direct.type=photons"};
  const auto render = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render", "scene.toml"});
    arguments.insert(arguments.end(), common.begin(), common.end());
    vpm_succeeds(arguments);
    return read_exr(path(arguments[3]));
  };
  const Image whole = render({"-o", "whole.exr", "--passes", "4"});
  render({"-o", "part.exr", "--passes", "2", "--crop", "5,9,30,21", "--checkpoint"});
  const Image part = render({"-o", "part.exr", "--passes", "4", "--crop", "5,9,30,21", "--resume"});
  const PixelRect crop{5, 9, 30, 21};
  EXPECT_TRUE(same_pixels(cropped(part, crop), cropped(whole, crop)));
  vpm_refuses({"render", "scene.toml", "-o", "part.exr", "--passes", "6", "--crop", "5,9,30,22", "--resume", "--set",
               "integrator.radii=per-pixel", "--set", "integrator.direct.type=photons"},
              {"film.crop"});
}

TEST_F(VpmRender, ErrorsOfACropAreLoggedAgainstThatPartOfTheReference) {
  vpm_succeeds({"render", "scene.toml", "-o", "truth.exr", "--passes", "4"});
  vpm_succeeds(
      {"render", "scene.toml", "-o", "part.exr", "--passes", "4", "--crop", "5,9,30,21", "--reference", "truth.exr"});
  const std::string log = read("part.errors.csv");
  std::istringstream last(log.substr(log.find("\n4,") + 1));
  std::vector<std::string> fields;
  for (std::string field; std::getline(last, field, ',');) fields.push_back(field);
  ASSERT_GT(fields.size(), 4u) << log;
  EXPECT_EQ(fields[0], "4");
  EXPECT_EQ(fields[4], "1");  // the mean over the reference's, which has the very same passes
}

/// As arrays of the crops alone would be; the crop of another film, or none in common, is refused.
TEST_F(VpmRender, ErrorsOfACropAreThoseOfItsPixels) {
  vpm_succeeds({"render", "scene.toml", "-o", "truth.exr", "--passes", "2", "--seed", "7"});
  vpm_succeeds({"render", "scene.toml", "-o", "part.exr", "--passes", "2", "--crop", "5,9,30,21"});
  const auto told =
      nlohmann::json::parse(vpm_succeeds({"error", "part.exr", "truth.exr", "--json", "--worst", "1"}).out);
  const PixelRect crop{5, 9, 30, 21};
  const Image part = cropped(read_exr(path("part.exr")), crop), truth = cropped(read_exr(path("truth.exr")), crop);
  EXPECT_EQ(told["width"], 25);
  EXPECT_NEAR(told["relative_mse"]["value"], relative_mse(part, truth), 1e-9);
  const PixelError worst = worst_pixels(part, truth, 1)[0];
  EXPECT_EQ(told["worst_pixels"][0]["x"], 5 + worst.x);
  EXPECT_EQ(told["worst_pixels"][0]["y"], 9 + worst.y);
  vpm_succeeds({"error", "part.exr", "truth.exr", "-o", "off.exr"});
  EXPECT_EQ(read_exr_channels(path("off.exr")).held, crop);
  vpm_succeeds({"render", "scene.toml", "-o", "other.exr", "--passes", "2", "--crop", "31,9,35,21"});
  vpm_refuses({"error", "part.exr", "other.exr"}, {"no pixel in common"});
  vpm_refuses({"error", "--series", "part.exr", "truth.exr"}, {"part.exr is a crop"});
  vpm_refuses({"render", "scene.toml", "-o", "more.exr", "--crop", "4,9,30,21", "--reference", "part.exr"},
              {"lacks pixels that are rendered"});
}

TEST_F(VpmRender, SizeAndSamplesAreThoseOfTheOptions) {
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--size", "31x17", "--spp", "3", "--passes", "1"});
  const Image picture = read_exr(path("a.exr"));
  EXPECT_EQ(picture.width, 31);
  EXPECT_EQ(picture.height, 17);
  EXPECT_EQ(report("a.json")["eye"]["camera_rays"], 31 * 17 * 3);
}

TEST_F(VpmRender, QuietSaysNothing) {
  const ProcessResult result = vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--quiet", "--set",
                                             "integrator.volume.radius=auto", "--progress", "always"});
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "");
}

TEST_F(VpmRender, RefusesSizesAndCropsThatAreNone) {
  for (const char* size : {"640", "640x", "0x480", "640x480x2", "640x480x", "axb"})
    vpm_refuses({"render", "scene.toml", "--size", size}, {"--size", "no size in pixels such as 640x480"});
  for (const char* crop : {"0,0,1", "0,0,9,9,", "-1,0,3,3", "0,0,1.5,2"})
    vpm_refuses({"render", "scene.toml", "--crop", crop}, {"--crop", "no part of a picture"});
  for (const char* crop : {"0,0,41,24", "7,3,7,9", "9,3,8,9"})
    vpm_refuses({"render", "scene.toml", "--crop", crop}, {"film.crop", "no part of the 40 x 24 pixels"});
  vpm_refuses({"render", "scene.toml", "--spp", "0"}, {"--spp"});
}

TEST_F(VpmRender, TonemapWritesThePreview) {
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr", "--exposure", "1.5"});
  vpm_succeeds({"tonemap", "a.exr", "b.png", "--exposure", "1.5"});
  EXPECT_TRUE(read("a.png") == read("b.png"));
  vpm_succeeds({"render", "scene.toml", "-o", "a.exr"});
  vpm_succeeds({"tonemap", "a.exr", "b.png"});
  EXPECT_TRUE(read("a.png") == read("b.png"));
  vpm_refuses({"tonemap", "a.exr", "b.jpg"}, {"b.jpg", "must end in .png"});
  vpm_refuses({"tonemap", "none.exr", "b.png"}, {"none.exr", "no such file"});
}

TEST_F(VpmRender, ViewShowsAGridAndWritesItsScene) {
  vpm_succeeds({"view", "smoke.vdb", "-o", "a.exr", "--size", "48x48", "--passes", "2", "--scene", "made.toml"});
  const Image picture = read_exr(path("a.exr"));
  EXPECT_EQ(picture.width, 48);
  EXPECT_GT(sum(picture), 0.0);
  EXPECT_NE(read("a.json").find("as passes are counted"), std::string::npos);
  const nlohmann::json told = report("a.json");
  EXPECT_EQ(told["settings"]["integrator.type"], "photon-map");
  for (const nlohmann::json& choice : told["chosen"]) EXPECT_NE(choice["key"], "integrator.type");
  std::vector<std::string> again{"render", "made.toml", "-o", "b.exr", "--size",
                                 "48x48",  "--passes",  "2",  "--set", "integrator.type=photon-map"};
  for (const nlohmann::json& choice : told["chosen"])
    again.insert(again.end(), {"--set", choice["key"].get<std::string>() + "=" + choice["value"].get<std::string>()});
  vpm_succeeds(again);
  EXPECT_TRUE(same_pixels(picture, read_exr(path("b.exr"))));
  vpm_refuses({"view", "smoke.vdb", "--scene", "made.toml"}, {"'made.toml' is there already"});
  std::filesystem::create_directories(path("folder"));
  vpm_succeeds({"view", "smoke.vdb", "--size", "8x8", "--passes", "1", "--scene", "folder/made.toml"});
  EXPECT_NE(read("folder/made.toml").find("path = \"../smoke.vdb\""), std::string::npos);
  vpm_succeeds({"view", "smoke.vdb", "--size", "48x48", "--passes", "1", "--quiet"});
  EXPECT_TRUE(std::filesystem::exists(path("smoke.exr")));
}

TEST_F(VpmRender, ViewRefusesWhatIsNoGrid) {
  vpm_refuses({"view", "scene.toml"}, {"scene.toml"});
  vpm_refuses({"view", "none.vdb"}, {"none.vdb"});
  vpm_refuses({"view", "smoke.vdb", "--optical-depth", "0"}, {"--optical-depth"});
  vpm_refuses({"view", "smoke.vdb", "--grid", "heat"}, {"no grid 'heat'", "density"});
  vpm_refuses({"view", "smoke.vdb", "--scene", "made.txt"}, {"must end in .toml"});
}

}  // namespace
}  // namespace vpm
