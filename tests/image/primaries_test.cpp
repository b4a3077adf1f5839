// Colours of other primaries: their matrices against published ones, and white that stays white.
#include "vpm/image/primaries.h"

#include <gtest/gtest.h>

#include "vpm/base/error.h"

namespace vpm {
namespace {

/// Of rows.
void expect_matrix(const glm::dmat3& m, const std::vector<double>& rows, double tolerance) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      EXPECT_NEAR(m[column][row], rows[static_cast<size_t>(3 * row + column)], tolerance) << row << " " << column;
}

TEST(Primaries, ThoseOfRec709Stay) {
  EXPECT_TRUE(Primaries().are_those_of_rec709());
  EXPECT_FALSE((Primaries{.red = {0.708, 0.292}}).are_those_of_rec709());
  expect_matrix(to_rec709({}), {1, 0, 0, 0, 1, 0, 0, 0, 1}, 1e-12);
}

/// [ITU2017, sec. 2.2] gives four digits.
TEST(Primaries, Rec2020BecomesRec709AsItsReportHasIt) {
  const Primaries rec2020{{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}};
  expect_matrix(to_rec709(rec2020), {1.6605, -0.5876, -0.0728, -0.1246, 1.1329, -0.0083, -0.0182, -0.1006, 1.1187},
                6e-5);
}

TEST(Primaries, WhiteStaysWhite) {
  const Primaries aces{{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.077}, {0.32168, 0.33767}};
  const glm::dvec3 white = to_rec709(aces) * glm::dvec3(1.0);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1.0, 1e-12);
}

/// As OpenEXR's own examples of X, Y and Z have it: red and blue of no luminance. What is white there is white here.
TEST(Primaries, OfXyzAreConverted) {
  const Primaries xyz{{1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}, {1.0 / 3.0, 1.0 / 3.0}};
  const glm::dvec3 white = to_rec709(xyz) * glm::dvec3(1.0);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1.0, 1e-12);
  const glm::dvec3 green = to_rec709(xyz) * glm::dvec3(0.0, 1.0, 0.0);
  EXPECT_LT(green.r, 0.0);
  EXPECT_GT(green.g, 1.0);
}

/// By each list's name of a space: a matrix of primaries, of which rows of white are 1.
TEST(Primaries, OfNamedSpacesAreThoseOfTheirStandards) {
  for (const char* name :
       {"lin_ap1_scene", "ACEScg", "lin_ap0_scene", "ACES2065-1", "lin_rec2020_scene", "lin_p3d65_scene"}) {
    const std::optional<Primaries> named = primaries_named(name);
    ASSERT_TRUE(named) << name;
    EXPECT_FALSE(named->are_those_of_rec709()) << name;
    EXPECT_FALSE(is_encoded(name)) << name;
  }
  EXPECT_EQ(primaries_named("ACEScg")->red, glm::dvec2(0.713, 0.293));
  EXPECT_TRUE(primaries_named("lin_rec709_scene")->are_those_of_rec709());
  EXPECT_TRUE(primaries_named("Linear")->are_those_of_rec709());
  EXPECT_FALSE(primaries_named("raw"));
  for (const char* name : {"sRGB", "srgb_rec709_display", "ACEScct", "g22_rec709_tx"})
    EXPECT_TRUE(is_encoded(name)) << name;
}

TEST(Primaries, OfZerosAreNone) {
  const glm::dvec2 zero(0.0);
  EXPECT_TRUE((Primaries{zero, zero, zero, zero}).are_those_of_rec709());
}

TEST(Primaries, ThatSpanNoColoursAreRefused) {
  EXPECT_THROW(to_rec709({.green = {0.64, 0.33}}), InputError);
  EXPECT_THROW(to_rec709({.white = {0.3, 0.0}}), InputError);
}

}  // namespace
}  // namespace vpm
