// Which channels are a file's picture, by the names that programs give them.
#include "vpm/image/exr_layers.h"

#include <gtest/gtest.h>

#include "vpm/base/error.h"

namespace vpm {
namespace {

using Colour = std::array<std::string, 3>;

ExrColour chosen(const std::vector<std::string>& channels, const std::string& layer = "") {
  return choose_colour({{"", channels}}, layer);
}

std::string refusal(const std::vector<ExrPartNames>& parts, const std::string& layer = "") {
  try {
    choose_colour(parts, layer);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ExrLayers, TheLayerWithoutANameIsThePicture) {
  EXPECT_EQ(chosen({"A", "B", "G", "R", "variance.B", "variance.G", "variance.R"}).channels, (Colour{"R", "G", "B"}));
  EXPECT_EQ(chosen({".B", ".G", ".R"}).channels, (Colour{".R", ".G", ".B"}));
  EXPECT_EQ(chosen({"b", "g", "r"}).channels, (Colour{"r", "g", "b"}));
  EXPECT_EQ(chosen({"blue", "green", "red"}).channels, (Colour{"red", "green", "blue"}));
}

TEST(ExrLayers, TheOnlyLayerOfColourIsThePicture) {
  EXPECT_EQ(chosen({"rgba.A", "rgba.B", "rgba.G", "rgba.R", "depth.Z", "N.X", "N.Y", "N.Z"}).channels,
            (Colour{"rgba.R", "rgba.G", "rgba.B"}));
}

/// Blender's multilayer files.
TEST(ExrLayers, OfSeveralTheOneCalledCombinedIsThePicture) {
  const std::vector<std::string> blender = {"ViewLayer.Combined.A", "ViewLayer.Combined.B", "ViewLayer.Combined.G",
                                            "ViewLayer.Combined.R", "ViewLayer.Depth.Z",    "ViewLayer.DiffDir.B",
                                            "ViewLayer.DiffDir.G",  "ViewLayer.DiffDir.R"};
  EXPECT_EQ(chosen(blender).channels[0], "ViewLayer.Combined.R");
  EXPECT_EQ(chosen(blender, "ViewLayer.DiffDir").channels[0], "ViewLayer.DiffDir.R");
  EXPECT_EQ(chosen(blender, "DiffDir").channels[2], "ViewLayer.DiffDir.B");
  EXPECT_EQ(chosen(blender, "ViewLayer.Depth.Z").channels,
            (Colour{"ViewLayer.Depth.Z", "ViewLayer.Depth.Z", "ViewLayer.Depth.Z"}));
  EXPECT_NE(refusal({{"", {"a.R", "a.G", "a.B", "b.R", "b.G", "b.B"}}}).find("the key 'layer'): a, b"),
            std::string::npos);
  EXPECT_NE(
      refusal({{"", blender}}, "Glossy").find("'Glossy'; its layers of colour are: ViewLayer.Combined, ViewLayer."),
      std::string::npos);
}

TEST(ExrLayers, ThePartOfThePictureMayStandAnywhere) {
  const std::vector<ExrPartNames> parts = {{"depth", {"Z"}}, {"colour", {"B", "G", "R"}}};
  EXPECT_EQ(choose_colour(parts, "").part, 1u);
  const std::vector<ExrPartNames> eyes = {{"left", {"B", "G", "R"}}, {"right", {"B", "G", "R"}}};
  EXPECT_NE(
      refusal(eyes).find("more than one picture; ask for one by its name (--layer, or the key 'layer'): left, right"),
      std::string::npos);
  EXPECT_EQ(choose_colour(eyes, "right").part, 1u);
  EXPECT_NE(refusal(eyes, "G").find("no layer, or more than one, is named 'G'"), std::string::npos);
  EXPECT_EQ(
      choose_colour({{"rgb", {"Combined.B", "Combined.G", "Combined.R"}}, {"x", {"Other.B", "Other.G", "Other.R"}}}, "")
          .part,
      0u);
}

TEST(ExrLayers, GreyIsYOrAFilesOnlyChannel) {
  EXPECT_EQ(chosen({"A", "Y"}).channels, (Colour{"Y", "Y", "Y"}));
  EXPECT_EQ(chosen({"density"}).channels, (Colour{"density", "density", "density"}));
}

TEST(ExrLayers, DepthsPlacesAndSharesAreNoPicture) {
  for (const auto& channels : std::vector<std::vector<std::string>>{
           {"Z"},
           {"A"},
           {"depth.Z"},
           {"depth.R"},
           {"Depth.Y"},
           {"X", "Y", "Z"},
           {"N.X", "N.Y", "N.Z"},
           {"G", "R"},
           {"CryptoObject00.a", "CryptoObject00.b", "CryptoObject00.g", "CryptoObject00.r"}})
    EXPECT_NE(refusal({{"", channels}}).find("it holds no picture"), std::string::npos) << channels[0];
  EXPECT_NE(refusal({{"depth", {"Y"}}}).find("it holds no picture"), std::string::npos);
  EXPECT_NE(refusal({{"", {"BY", "RY", "Y"}}}).find("luminance and chroma"), std::string::npos);
  EXPECT_EQ(chosen({"Y", "Z"}).channels[0], "Y");
  EXPECT_EQ(chosen({"X", "Y", "Z"}, "Z").channels, (Colour{"Z", "Z", "Z"}));
}

}  // namespace
}  // namespace vpm
