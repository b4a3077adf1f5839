// Pictures of Radiance: each way of packing, what their headers say, and refusals of what is damaged.
#include "vpm/image/hdr.h"

#include <gtest/gtest.h>

#include <fstream>

#include "support/test_file.h"
#include "vpm/base/error.h"

namespace vpm {
namespace {

const std::string kHead = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";

std::string write_file(const std::string& bytes) {
  const std::string path = test_file("picture.hdr");
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::string bytes_of(const std::vector<int>& values) {
  std::string bytes;
  for (const int value : values) bytes += static_cast<char>(value);
  return bytes;
}

HdrPicture read(const std::string& bytes) { return read_hdr(write_file(bytes)); }

std::string refusal(const std::string& bytes) {
  try {
    read(bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Of 8 pixels: mantissas 10 to 17 of red, 20 of green, 30 to 33 and four of 40 of blue, of which one step is 1/2.
void expect_row(const Image& image) {
  ASSERT_EQ(image.width, 8);
  ASSERT_EQ(image.height, 1);
  for (int x = 0; x < 8; ++x)
    EXPECT_EQ(image.at(x, 0),
              0.5f * Rgb(10.5f + static_cast<float>(x), 20.5f, x < 4 ? 30.5f + static_cast<float>(x) : 40.5f));
}
constexpr int kHalf = 135;  // the exponent of a step of 1/2

TEST(Hdr, ReadsRowsPackedByKind) {
  const std::string row =
      bytes_of({2, 2, 0, 8, 8, 10, 11, 12, 13, 14, 15, 16, 17, 136, 20, 4, 30, 31, 32, 33, 132, 40, 136, kHalf});
  expect_row(read(kHead + "\n-Y 1 +X 8\n" + row).image);
}

/// Of 2 x 3 pixels, whose red numbers them in the file.
TEST(Hdr, ReadsAnyOrderOfPixels) {
  const auto reds = [](const std::string& size) {
    std::string pixels;
    for (int i = 0; i < 6; ++i) pixels += bytes_of({i, 9, 9, 136});
    const Image image = read(kHead + "\n" + size + "\n" + pixels).image;
    EXPECT_EQ(image.width, 2);
    EXPECT_EQ(image.height, 3);
    std::vector<int> numbers;
    for (const Rgb& pixel : image.pixels) numbers.push_back(static_cast<int>(pixel.r - 0.5f));
    return numbers;
  };
  EXPECT_EQ(reds("-Y 3 +X 2"), (std::vector<int>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(reds("-Y 3 -X 2"), (std::vector<int>{1, 0, 3, 2, 5, 4}));
  EXPECT_EQ(reds("+Y 3 +X 2"), (std::vector<int>{4, 5, 2, 3, 0, 1}));
  EXPECT_EQ(reds("+Y 3 -X 2"), (std::vector<int>{5, 4, 3, 2, 1, 0}));
  EXPECT_EQ(reds("+X 2 -Y 3"), (std::vector<int>{0, 3, 1, 4, 2, 5}));
  EXPECT_EQ(reds("+X 2 +Y 3"), (std::vector<int>{2, 5, 1, 4, 0, 3}));
  EXPECT_EQ(reds("-X 2 -Y 3"), (std::vector<int>{3, 0, 4, 1, 5, 2}));
  EXPECT_EQ(reds("-X 2 +Y 3"), (std::vector<int>{5, 2, 4, 1, 3, 0}));
}

/// Corrections of colours are divided out as exposures are; ImageMagick puts zeros for primaries, and a gamma.
TEST(Hdr, ReadsWhatHeadersSayOfColours) {
  const HdrPicture picture = read(
      "#?RADIANCE \nEXPOSURE=2\nCOLORCORR=1 2 4\nPRIMARIES=0 0 0 0 0 0 0 0\n"
      "GAMMA=0.454545\n\n-Y 1 +X 1\n" +
      bytes_of({100, 100, 100, 136}));
  EXPECT_EQ(picture.image.at(0, 0), 100.5f / Rgb(2.0f, 4.0f, 8.0f));
  ASSERT_EQ(picture.notes.size(), 2u);
  EXPECT_NE(picture.notes[0].find("'GAMMA=0.454545', which is not applied"), std::string::npos) << picture.notes[0];
  EXPECT_NE(picture.notes[1].find("its exposure, 2, 4 and 8, is divided out"), std::string::npos) << picture.notes[1];
}

TEST(Hdr, ReadsFlatRowsAndRunsOfPixels) {
  std::string flat, runs;
  for (int x = 0; x < 8; ++x) flat += bytes_of({10 + x, 20, x < 4 ? 30 + x : 40, kHalf});
  expect_row(read(kHead + "\n-Y 1 +X 8\n" + flat).image);
  const HdrPicture picture = read("#?RGBE\n\n-Y 2 +X 300\n" + bytes_of({5, 6, 7, 136, 1, 1, 1, 43, 1, 1, 1, 1}) +
                                  bytes_of({8, 8, 8, 136, 9, 9, 9, 136, 1, 1, 1, 42, 1, 1, 1, 1}));
  EXPECT_EQ(picture.image.at(299, 0), Rgb(5.5f, 6.5f, 7.5f));
  EXPECT_EQ(picture.image.at(0, 1), Rgb(8.5f));
  EXPECT_EQ(picture.image.at(299, 1), Rgb(9.5f));
}

TEST(Hdr, AnExponentOfZeroIsBlack) {
  EXPECT_EQ(read(kHead + "\n-Y 1 +X 1\n" + bytes_of({77, 0, 3, 0})).image.at(0, 0), Rgb(0.0f));
}

/// The product of all lines, as each program that scales a picture adds one.
TEST(Hdr, ExposureIsDividedOut) {
  const HdrPicture picture =
      read(kHead + "EXPOSURE=0.5\nEXPOSURE= 4.0\r\n\n-Y 1 +X 1\n" + bytes_of({128, 128, 128, 129}));
  EXPECT_EQ(picture.image.at(0, 0), Rgb(128.5f / 128.0f / 2.0f));
  EXPECT_EQ(picture.notes, std::vector<std::string>{"its exposure, 2, is divided out"});
}

TEST(Hdr, ColoursOfOtherPrimariesAreConverted) {
  const HdrPicture picture = read(kHead + "PRIMARIES=0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290\n\n-Y 1 +X 1\n" +
                                  bytes_of({100, 100, 100, 136}));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(picture.image.at(0, 0)[c], 100.5f, 1e-4f);
  EXPECT_EQ(picture.notes.size(), 1u);
}

TEST(Hdr, RefusesWhatIsDamagedOrMeansSomethingElse) {
  const std::string size = "\n-Y 1 +X 8\n";
  for (const auto& [bytes, words] : std::vector<std::pair<std::string, std::string>>{
           {"", "ends within its header"},
           {"#?RADIANCE\n", "ends within its header"},
           {"P6\n8 1\n255\n", "does not begin with #?RADIANCE"},
           {"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n" + size, "its format is '32-bit_rle_xyze'"},
           {kHead + "EXPOSURE=0\n" + size, "no positive number"},
           {kHead + "EXPOSURE=bright\n" + size, "no positive number"},
           {kHead + "PRIMARIES=1 2 3\n" + size, "not eight numbers"},
           {kHead + "\n-Y 1 -Y 8\n", "is not as -Y HEIGHT +X WIDTH"},
           {kHead + "\n-Y 1 +X 8 and more\n", "is not as -Y HEIGHT +X WIDTH"},
           {kHead + "\n-Y 0 +X 8\n", "or are none"},
           {kHead + "\n-Y 65536 +X 65536\n", "more than 1 GiB"},
           {kHead + size, "ends within its pixels"},
           {kHead + size + bytes_of({2, 2, 0, 9}), "another length than the picture"},
           {kHead + size + bytes_of({2, 2, 0, 8, 0}), "longer than its row, or empty"},
           {kHead + size + bytes_of({2, 2, 0, 8, 137, 1}), "longer than its row, or empty"},
           {kHead + size + bytes_of({2, 2, 0, 8, 9}), "longer than its row, or empty"},
           {kHead + size + bytes_of({1, 1, 1, 3}), "longer than its row, or comes first"},
           {kHead + size + bytes_of({3, 1, 1, 3, 1, 1, 1, 8}), "longer than its row, or comes first"},
       })
    EXPECT_NE(refusal(bytes).find(words), std::string::npos) << words << ": " << refusal(bytes);
  EXPECT_THROW(read_hdr("no_such.hdr"), InputError);
}

}  // namespace
}  // namespace vpm
