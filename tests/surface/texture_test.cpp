// Texture look-ups: which texel stands where, what lies between, and the mean.
#include "vpm/surface/material/texture.h"

#include <gtest/gtest.h>

namespace vpm {
namespace {

/// Two rows of three texels; the top row is 0, 0.1, 0.2, the bottom one 0.3, 0.4, 0.5.
Image picture() {
  Image image(3, 2);
  for (size_t i = 0; i < 6; ++i) image.pixels[i] = Rgb(0.1f * static_cast<float>(i));
  return image;
}

TEST(Texture, ShowsTheBottomRowAtTheStartOfV) {
  const Texture nearest(picture(), TextureFilter::nearest), bilinear(picture(), TextureFilter::bilinear);
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 2; ++y) {
      const Vec2 center((static_cast<float>(x) + 0.5f) / 3.0f, 1.0f - (static_cast<float>(y) + 0.5f) / 2.0f);
      EXPECT_EQ(nearest.at(center), picture().at(x, y));
      EXPECT_NEAR(bilinear.at(center).r, picture().at(x, y).r, 1e-6f);
    }
}

TEST(Texture, IsLinearBetweenCentersAndRepeats) {
  const Texture texture(picture(), TextureFilter::bilinear);
  EXPECT_NEAR(texture.at({1.0f / 3.0f, 0.25f}).r, 0.35f, 1e-6f);  // between the first two of the bottom row
  EXPECT_NEAR(texture.at({0.5f, 0.5f}).r, 0.25f, 1e-6f);          // between the middle ones
  EXPECT_NEAR(texture.at({0.0f, 0.75f}).r, 0.1f, 1e-6f);          // between the last and the first
  EXPECT_NEAR(texture.at({0.5f, 0.0f}).r, 0.25f, 1e-6f);          // between bottom and top
  EXPECT_NEAR(texture.at({1.0f / 6.0f + 1.0f / 12.0f, 0.75f}).r, 0.025f, 1e-6f);  // a quarter of the way
  for (const Vec2& uv : {Vec2(0.1f, 0.2f), Vec2(0.9f, 0.95f), Vec2(0.0f, 1.0f)})
    for (const Vec2& cells : {Vec2(1, 0), Vec2(-1, 2), Vec2(0, -3)})
      EXPECT_NEAR(texture.at(uv + cells).r, texture.at(uv).r, 1e-5f);
}

TEST(Texture, TakesAnyFiniteCoordinate) {
  for (const TextureFilter filter : {TextureFilter::bilinear, TextureFilter::nearest}) {
    const Texture texture(picture(), filter), dot(Image(1, 1), filter);
    for (const float u : {0.0f, -0.0f, 1.0f, -1e-10f, 0.99999994f, 1e6f, -1e6f, 1e-38f})
      for (const float v : {0.0f, 1.0f, -1e-10f, 1e6f}) {
        const float value = texture.at({u, v}).r;
        EXPECT_TRUE(value >= 0.0f && value <= 0.5f) << u << " " << v;
        EXPECT_EQ(dot.at({u, v}), Rgb(0.0f));
      }
  }
}

TEST(Texture, HasTheMeanOfACheckerForEitherFilter) {
  Image checker(4, 6);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 4; ++x) checker.at(x, y) = (x + y) % 2 ? Rgb(0.9f, 0.6f, 0.2f) : Rgb(0.1f, 0.2f, 0.2f);
  for (const TextureFilter filter : {TextureFilter::bilinear, TextureFilter::nearest}) {
    const Texture texture(checker, filter);
    // The midpoints of 8 cells for each texel: exact for what is linear between centers.
    Rgbd sum(0.0);
    for (int i = 0; i < 32; ++i)
      for (int j = 0; j < 48; ++j)
        sum += Rgbd(texture.at({(static_cast<float>(i) + 0.5f) / 32.0f, (static_cast<float>(j) + 0.5f) / 48.0f}));
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(texture.mean()[c], Rgb(0.5f, 0.4f, 0.2f)[c], 1e-6f);
      EXPECT_NEAR(sum[c] / (32.0 * 48.0), texture.mean()[c], 1e-6f);
    }
    EXPECT_FALSE(texture.grey());
  }
  EXPECT_TRUE(Texture(picture(), TextureFilter::nearest).grey());
}

}  // namespace
}  // namespace vpm
