// Scene files: skies of other programs' pictures.
#include <gtest/gtest.h>

#include "image/openexr_envmaps.h"
#include "input/expectations.h"
#include "input/scene_text.h"
#include "vpm/image/exr.h"

namespace vpm {
namespace {

/// A picture whose red counts its pixels, from 1.
Image numbered(int width, int height) {
  Image image(width, height);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Rgb(static_cast<float>(i + 1), 1.0f, 1.0f);
  return image;
}

RenderJob load_sky(const std::string& keys) {
  return load_with(
      "[[shapes]]\ntype = 'sphere'\ncenter = [0, 0, 0]\nradius = 1\nmaterial = { type = 'mirror' }\n"
      "[[lights]]\ntype = 'environment'\n" +
      keys + "\n");
}

const ImageEnvironment& sky_of(const RenderJob& job) { return *std::get<EnvironmentMap>(job.scene.lights[1]).image; }

void expect_refusal(const std::string& keys, const std::string& words) {
  const std::string message = message_of([&] { load_sky(keys); });
  EXPECT_NE(message.find(words), std::string::npos) << message;
  EXPECT_NE(message.find("scene.toml:"), std::string::npos) << message;
}

TEST(SceneSky, IsTurnedAboutAnAxis) {
  write_exr(test_file("sky.exr"), numbered(4, 2), {}, {});
  const auto job = load_sky("path = 'sky.exr'");
  EXPECT_TRUE(job.notes.empty());
  const auto turned = load_sky("path = 'sky.exr'\nrotation = { axis = [2, 0, 0], degrees = 90 }");
  // About x, +y goes to +z, and +z to -y.
  for (const Vec3& d : {Vec3(0.6f, 0.7f, 0.2f), Vec3(-0.6f, 0.7f, 0.2f), Vec3(0.3f, -0.7f, 0.5f)})
    EXPECT_EQ(sky_of(turned).radiance(glm::normalize(Vec3(d.x, -d.z, d.y))), sky_of(job).radiance(glm::normalize(d)));
}

TEST(SceneSky, OfAnotherShapeIsNoted) {
  const auto note = [](int width, int height, const std::string& keys = "") {
    write_exr(test_file("sky.exr"), numbered(width, height), {}, {});
    const RenderJob job = load_sky("path = 'sky.exr'\n" + keys);
    return job.notes.empty() ? "" : job.notes.at(0);
  };
  EXPECT_NE(note(4, 3).find("4 x 3 pixels, and equirectangular pictures are twice as wide"), std::string::npos);
  EXPECT_NE(note(4, 4).find("mapping = \"equal-area\""), std::string::npos);
  EXPECT_EQ(note(4, 4, "mapping = 'equal-area'"), "");
  EXPECT_EQ(note(4, 3, "mapping = 'equirectangular'"), "");
  EXPECT_EQ(note(4, 2), "");
  write_exr(test_file("sky.exr"), numbered(4, 2), {}, {});
  expect_refusal("path = 'sky.exr'\nmapping = 'equal-area'", "is a square, and this one has 4 x 2 pixels");
}

TEST(SceneSky, IsClampedWhereThatIsAskedFor) {
  Image image = numbered(4, 2);
  image.pixels[1].g = -0.001f;
  image.pixels[2].b = std::numeric_limits<float>::infinity();
  write_exr(test_file("sky.exr"), image, {}, {});
  expect_refusal("path = 'sky.exr'", "clamp_negative = true");
  const RenderJob job = load_sky("path = 'sky.exr'\nclamp_negative = true");
  ASSERT_EQ(job.notes.size(), 1u);
  EXPECT_NE(job.notes[0].find("2 pixels were negative or infinite"), std::string::npos) << job.notes[0];
  EXPECT_EQ(sky_of(job).radiance(glm::normalize(Vec3(1.0f, 0.5f, 0.1f))), Rgb(2.0f, 0.0f, 1.0f));
  EXPECT_EQ(sky_of(job).radiance(glm::normalize(Vec3(-0.1f, 0.5f, 1.0f))), Rgb(3.0f, 1.0f, 65504.0f));
  image.pixels[3].r = std::numeric_limits<float>::quiet_NaN();
  write_exr(test_file("sky.exr"), image, {}, {});
  expect_refusal("path = 'sky.exr'\nclamp_negative = true", "the radiance at column 3, row 0 is no number");
}

TEST(SceneSky, HasALayer) {
  const Image sky = numbered(4, 2);
  write_exr(test_file("sky.exr"), Image(4, 2), {{"dome", &sky}}, {});
  EXPECT_EQ(sky_of(load_sky("path = 'sky.exr'\nlayer = 'dome'")).radiance({0, -1, 0}), Rgb(7.0f, 1.0f, 1.0f));
  expect_refusal("path = 'sky.exr'\nlayer = 'dom'", "dome");
}

TEST(SceneSky, IsReadFromRadiancesFiles) {
  std::ofstream(test_file("sky.hdr"), std::ios::binary)
      << "#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"
      << std::string("\x7f\x3f\x1f\x82\x7f\x7f\x7f\x82", 8);
  const RenderJob job = load_sky("path = 'sky.hdr'\nscale = 4");
  ASSERT_EQ(job.notes.size(), 1u);
  EXPECT_NE(job.notes[0].find("its exposure, 2, is divided out"), std::string::npos) << job.notes[0];
  EXPECT_EQ(sky_of(job).radiance({1, 0, 0}), Rgb(127.5f, 63.5f, 31.5f) / 32.0f);
  expect_refusal("path = 'sky.hdr'\nlayer = 'dome'", "'layer' is for .exr files");
  std::ofstream(test_file("sky.png")) << "a picture";
  expect_refusal("path = 'sky.png'", "a sky must be a .exr or .hdr file");
}

TEST(SceneSky, OfACubesFacesIsRefused) {
  write_envmap(test_file("faces.exr"), true);
  expect_refusal("path = 'faces.exr'", "the six faces of a cube");
  write_envmap(test_file("faces.exr"), false);
  EXPECT_EQ(load_sky("path = 'faces.exr'").notes.size(), 1u) << "its shape is noted";
}

}  // namespace
}  // namespace vpm
