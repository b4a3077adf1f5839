// The preview, read back with libpng, shows the bytes that the sRGB curve asks for.
#include "vpm/image/png.h"

#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "vpm/base/error.h"

namespace vpm {
namespace {

namespace fs = std::filesystem;
using Byte3 = std::array<int, 3>;

class Png : public testing::Test {
 protected:
  ~Png() override { fs::remove(file_); }

  std::vector<Byte3> read(int width, int height) const {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_file(&png, file_.c_str())) << png.message;
    EXPECT_EQ(png.width, static_cast<png_uint_32>(width));
    EXPECT_EQ(png.height, static_cast<png_uint_32>(height));
    EXPECT_EQ(png.format, static_cast<png_uint_32>(PNG_FORMAT_RGB));
    std::vector<uint8_t> bytes(PNG_IMAGE_SIZE(png));
    EXPECT_TRUE(png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr)) << png.message;
    std::vector<Byte3> pixels;
    for (size_t i = 0; i + 2 < bytes.size(); i += 3) pixels.push_back({bytes[i], bytes[i + 1], bytes[i + 2]});
    return pixels;
  }

  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  const fs::path file_ = fs::path(testing::TempDir()) / ("vpm-png-test-" + std::to_string(getpid()) + ".png");
};

TEST_F(Png, CurveAndOrder) {
  Image image(3, 2);
  image.at(0, 0) = {0.0f, 0.5f, 1.0f};     // 0.5 -> 0.7354 * 255
  image.at(1, 0) = {-1.0f, 2.0f, 0.18f};   // clipped; 0.18 -> 0.4614 * 255
  image.at(2, 0) = {0.002f, 0.0f, 0.0f};   // linear part: 12.92 * 0.002 * 255 = 6.6
  image.at(0, 1) = {0.0f, 0.2140f, 0.0f};  // half grey
  image.at(2, 1) = {1e30f, 1e-30f, 1.0f};
  EXPECT_EQ(write_png(file_, image, 0.0f), 0u);
  const std::vector<Byte3> expected = {{0, 188, 255}, {0, 255, 118}, {7, 0, 0}, {0, 127, 0}, {0, 0, 0}, {255, 0, 255}};
  EXPECT_EQ(read(3, 2), expected);
}

TEST_F(Png, ExposureIsInStops) {
  Image image(2, 1);
  image.at(0, 0) = Rgb(0.25f);
  image.at(1, 0) = Rgb(0.125f);
  write_png(file_, image, 1.0f);
  const std::vector<Byte3> expected = {{188, 188, 188}, {137, 137, 137}};
  EXPECT_EQ(read(2, 1), expected);
  write_png(file_, image, 200.0f);  // an infinite gain
  const std::vector<Byte3> white(2, Byte3{255, 255, 255});
  EXPECT_EQ(read(2, 1), white);
}

TEST_F(Png, NonFinitePixelsAreMagentaAndCounted) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Image image(4, 1);
  image.at(0, 0) = {nan, 0.0f, 0.0f};
  image.at(1, 0) = {0.0f, kInfinity, nan};
  image.at(2, 0) = {0.0f, 0.0f, -kInfinity};
  EXPECT_EQ(write_png(file_, image, -3.0f), 3u);
  const std::vector<Byte3> expected = {{255, 0, 255}, {255, 0, 255}, {255, 0, 255}, {0, 0, 0}};
  EXPECT_EQ(read(4, 1), expected);
}

TEST_F(Png, ABlackPixelStaysBlackUnderAnyExposure) {
  EXPECT_EQ(write_png(file_, Image(1, 1), 200.0f), 0u);
  EXPECT_EQ(read(1, 1), std::vector<Byte3>(1, Byte3{0, 0, 0}));
}

TEST_F(Png, EqualPicturesGiveEqualBytes) {
  Image image(31, 17);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Rgb(static_cast<float>(i) / 527.0f, 0.3f, 0.1f);
  write_png(file_, image, 0.0f);
  const std::string first = bytes();
  write_png(file_, image, 0.0f);
  EXPECT_EQ(bytes(), first);
  EXPECT_EQ(first.find("tIME"), std::string::npos);
}

TEST_F(Png, RefusedPath) {
  EXPECT_THROW(write_png(file_ / "missing" / "x.png", Image(1, 1), 0.0f), InputError);
  EXPECT_THROW(write_png(testing::TempDir(), Image(1, 1), 0.0f), InputError);
}

TEST(AutoExposure, PutsThe99thPercentileAtFourFifths) {
  Image image(100, 10);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Rgb(static_cast<float>(i + 1));
  const float exposure = auto_exposure(image);
  EXPECT_NEAR(990.0f * std::exp2(exposure), 0.8f, 0.001f);
  for (size_t i = 991; i < 1000; ++i) image.pixels[i] = Rgb(1e20f);  // fireflies do not darken the picture
  EXPECT_EQ(auto_exposure(image), exposure);
}

TEST(AutoExposure, IgnoresBlackSurroundingsAndNonFinitePixels) {
  Image image(100, 100);
  EXPECT_EQ(auto_exposure(image), 0.0f);
  image.at(3, 4) = Rgb(0.1f);
  EXPECT_FLOAT_EQ(auto_exposure(image), 3.0f);
  image.at(5, 5) = Rgb(kInfinity);
  image.at(6, 5) = Rgb(std::numeric_limits<float>::quiet_NaN());
  EXPECT_FLOAT_EQ(auto_exposure(image), 3.0f);
}

TEST_F(Png, ReadsWhatItWrote) {
  Image image(2, 2);
  image.pixels = {Rgb(0.0f, 0.5f, 1.0f), Rgb(0.18f), Rgb(0.002f, 0.9f, 0.3f), Rgb(1.0f)};
  write_png(file_, image, 0.0f);
  const Image linear = read_png(file_, PngValues::srgb), raw = read_png(file_, PngValues::linear);
  ASSERT_EQ(linear.width, 2);
  ASSERT_EQ(linear.height, 2);
  for (size_t i = 0; i < 4; ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(linear.pixels[i][c], image.pixels[i][c], 0.0045f);  // half a step at 1
  EXPECT_EQ(raw.pixels[0], Rgb(0.0f, 188.0f / 255.0f, 1.0f));
  // A byte read and written again is the same byte.
  write_png(file_, linear, 0.0f);
  EXPECT_EQ(read_png(file_, PngValues::linear).pixels, raw.pixels);
}

TEST_F(Png, ReadsGreyAndOpaqueFiles) {
  const fs::path folder = fs::path(VPM_SOURCE_DIR) / "tests/input/textures";
  const Image grey = read_png(folder / "grey.png", PngValues::linear);
  EXPECT_EQ(grey.pixels, (std::vector<Rgb>{Rgb(0.0f), Rgb(188.0f / 255.0f)}));
  EXPECT_EQ(read_png(folder / "opaque.png", PngValues::linear).pixels[0], Rgb(1.0f, 0.0f, 188.0f / 255.0f));
  for (const char* name : {"damaged.png", "transparent.png", "16_bits.png", "none.png"})
    EXPECT_THROW(read_png(folder / name, PngValues::srgb), InputError) << name;
}

// Text of 1.8 GB is announced, of which there are eleven bytes.
TEST_F(Png, RefusesChunksLongerThanTheFile) {
  try {
    read_png(fs::path(VPM_SOURCE_DIR) / "tests/fuzz/corpus/png/long_chunk.png", PngValues::srgb);
    ADD_FAILURE() << "it is read";
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* part : {"long_chunk.png' is cut off", "at byte 33", "1767135348 bytes", "and 11 do"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace vpm
