// Polygons as triangles: those of each kind cover what the polygon does, and nothing else.
#include "vpm/input/mesh/split_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/borders.h"
#include "vpm/base/rng.h"

namespace vpm {
namespace {

using Polygon = std::vector<Vec2>;
using Triangle = std::array<uint32_t, 3>;

std::vector<Vec3> in_space(const Polygon& polygon, const glm::mat3& rotation = glm::mat3(1.0f)) {
  std::vector<Vec3> corners;
  for (const Vec2& p : polygon) corners.push_back(rotation * Vec3(p, 0.5f));
  return corners;
}

PolygonSplit split_of(const std::vector<Vec3>& corners) {
  PolygonSplit split;
  split_polygon(corners, split);
  return split;
}

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  const glm::dvec2 u = glm::dvec2(b) - glm::dvec2(a), v = glm::dvec2(c) - glm::dvec2(a);
  return u.x * v.y - u.y * v.x;
}

/// Does a ray from the point to the right cross the polygon's edges an odd number of times?
bool is_inside(const Polygon& polygon, const Vec2& p) {
  bool inside = false;
  for (size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
    if ((polygon[i].y > p.y) != (polygon[j].y > p.y) &&
        p.x < (polygon[j].x - polygon[i].x) * (p.y - polygon[i].y) / (polygon[j].y - polygon[i].y) + polygon[i].x)
      inside = !inside;
  return inside;
}

/// Each of the polygon's places lies in one triangle, others in none; and all turn as it does. From whichever corner it
/// begins, on either side, and askew.
void expect_covers(const Polygon& given) {
  Rng rng(5, 0, given.size());
  const glm::mat3 rotations[] = {glm::mat3(1.0f), some_rotation(rng)};
  for (const glm::mat3& rotation : rotations)
    for (size_t first = 0; first < given.size(); ++first)
      for (const bool mirrored : {false, true}) {
        Polygon polygon = given;
        std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(first), polygon.end());
        if (mirrored) std::reverse(polygon.begin(), polygon.end());
        const PolygonSplit split = split_of(in_space(polygon, rotation));
        ASSERT_FALSE(split.crosses_itself) << first;
        EXPECT_TRUE(split.flat);
        EXPECT_EQ(split.triangles.size(), polygon.size() - 2);
        for (int i = 0; i < 500; ++i) {
          const Vec2 p = 10.0f * rng.uniform2() - Vec2(1.0f);
          int covered = 0;
          for (const auto& [a, b, c] : split.triangles) {
            const double turns[] = {turn(polygon[a], polygon[b], p), turn(polygon[b], polygon[c], p),
                                    turn(polygon[c], polygon[a], p)};
            covered +=
                std::all_of(std::begin(turns), std::end(turns), [&](double t) { return mirrored ? t < 0.0 : t > 0.0; });
          }
          ASSERT_EQ(covered, is_inside(polygon, p)) << first << " " << mirrored << " " << p.x << " " << p.y;
        }
      }
}

TEST(SplitPolygon, ConvexOnesAreFansFromTheirFirstCorner) {
  Polygon polygon;
  for (int i = 0; i < 7; ++i) polygon.push_back(4.0f + 3.0f * Vec2(std::cos(0.9f * i), std::sin(0.9f * i)));
  expect_covers(polygon);
  const PolygonSplit split = split_of(in_space(polygon));
  EXPECT_EQ(split.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}}));
}

/// With its inner corner on the straight line between two others, in the second.
TEST(SplitPolygon, RoomsKeepTheirNotch) {
  expect_covers({{0, 0}, {7, 0}, {7, 2}, {3, 2}, {3, 8}, {0, 8}});
  expect_covers({{0, 0}, {8, 0}, {8, 4}, {4, 4}, {4, 8}, {0, 8}});
  expect_covers({{0, 0}, {8, 0}, {8, 3}, {4, 3}, {4, 6}, {0, 6}});
  expect_covers({{0, 0}, {8, 0}, {8, 8}, {5, 8}, {5, 2}, {3, 2}, {3, 8}, {0, 8}});  // a U
}

TEST(SplitPolygon, StarsCombsAndSpiralsAreCovered) {
  Polygon star, comb;
  for (int i = 0; i < 12; ++i)
    star.push_back(4.0f + (i % 2 == 0 ? 4.0f : 1.5f) * Vec2(std::cos(0.5236f * i), std::sin(0.5236f * i)));
  expect_covers(star);
  for (int i = 0; i < 8; ++i) comb.insert(comb.end(), {{0.5f + i, i % 2 == 0 ? 1.0f : 7.0f}});
  comb.insert(comb.end(), {{8, 8}, {0, 8}});
  expect_covers(comb);
  expect_covers({{0, 0}, {8, 0}, {8, 8}, {1, 8}, {1, 3}, {5, 3}, {5, 5}, {3, 5}, {3, 6}, {6, 6}, {6, 2}, {0, 2}});
}

/// Corners on straight edges, as where walls meet; and a slit to a hole, whose corners stand twice.
TEST(SplitPolygon, StraightCornersAndSlitsAreCovered) {
  expect_covers({{0, 0}, {4, 0}, {8, 0}, {8, 2}, {5, 2}, {3, 2}, {3, 5}, {3, 8}, {0, 8}, {0, 4}});
  expect_covers({{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {2, 2}, {2, 6}, {6, 6}, {6, 2}, {2, 2}});
}

/// An hourglass, a spike that goes out and back, and two holes behind each other on one slit.
TEST(SplitPolygon, OnesThatTouchThemselvesAreCovered) {
  expect_covers({{0, 0}, {4, 4}, {8, 0}, {8, 8}, {4, 4}, {0, 8}});
  expect_covers({{0, 0}, {8, 0}, {9, 9}, {8, 0}, {8, 3}, {4, 3}, {4, 8}, {0, 8}});
  expect_covers({{0, 0},
                 {9, 0},
                 {9, 5},
                 {0, 5},
                 {0, 0},
                 {1, 1},
                 {1, 4},
                 {4, 4},
                 {4, 1},
                 {1, 1},
                 {4, 1},
                 {5, 2},
                 {5, 4},
                 {8, 4},
                 {8, 1},
                 {5, 2},
                 {4, 1},
                 {1, 1}});
  EXPECT_FALSE(split_of(in_space({{0, 0}, {1, 0}, {1, 1}, {1, 0}})).crosses_itself);
}

/// Positions are rounded to floats: the nearest to the first corner may turn either way.
TEST(SplitPolygon, CirclesOfManyCornersAreFans) {
  Polygon polygon;
  constexpr int kAround = 100'000;
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2.0 * kPiD * i / kAround;
    polygon.emplace_back(4.0 + 3.0 * std::cos(angle), 4.0 + 3.0 * std::sin(angle));
  }
  const PolygonSplit split = split_of(in_space(polygon));
  EXPECT_EQ(split.triangles.back(), (Triangle{0, kAround - 2, kAround - 1}));
  EXPECT_EQ(split.triangles.front(), (Triangle{0, 1, 2}));
}

/// A slit whose sides have corners of their own, which rounding moves across each other.
TEST(SplitPolygon, SlitsMayBeRounded) {
  Rng rng(6, 0, 0);
  for (int i = 0; i < 200; ++i) {
    const glm::mat3 rotation = some_rotation(rng);
    const Vec3 shift(100.0f * rng.uniform(), 100.0f * rng.uniform(), 0.0f);
    std::vector<Vec3> corners;
    for (const Vec2& p : Polygon{{0, 0},
                                 {9, 0},
                                 {9, 9},
                                 {0, 9},
                                 {0, 3},
                                 {2.1f, 3.7f},
                                 {5.1f, 4.7f},
                                 {5.5f, 6},
                                 {4, 6},
                                 {5.1f, 4.7f},
                                 {3.6f, 4.2f},
                                 {0, 3}})
      corners.push_back(rotation * (Vec3(p, 0.5f) + shift));
    EXPECT_FALSE(split_of(corners).crosses_itself) << i;
  }
}

/// A band of many corners, as of a river, is split at once: thousands in a blink.
TEST(SplitPolygon, LongBandsTakeNoTime) {
  Polygon band;
  constexpr int kAlong = 2000;
  for (int i = 0; i < kAlong; ++i) band.emplace_back(0.001f * i, std::sin(0.05f * i));
  for (int i = kAlong; i-- > 0;) band.emplace_back(0.001f * i, 0.1f + std::sin(0.05f * i));
  const PolygonSplit split = split_of(in_space(band));
  EXPECT_FALSE(split.crosses_itself);
  EXPECT_EQ(split.triangles.size(), band.size() - 2);
}

TEST(SplitPolygon, OnesThatCrossThemselvesHaveNoInside) {
  EXPECT_TRUE(split_of(in_space({{0, 0}, {1, 1}, {1, 0}, {0, 1}})).crosses_itself);
  EXPECT_TRUE(split_of(in_space({{0, 0}, {2, 2}, {2, 0}, {0, 1}})).crosses_itself);
  Polygon pentagram;
  for (int i = 0; i < 5; ++i) pentagram.emplace_back(std::cos(2.5133f * i), std::sin(2.5133f * i));
  EXPECT_TRUE(split_of(in_space(pentagram)).crosses_itself);
  // With a part that is wound twice, so that there are ears.
  EXPECT_TRUE(split_of(in_space({{0, 0}, {6, 0}, {6, 6}, {2, 2}, {8, 2}, {8, 8}, {0, 8}})).crosses_itself);
}

TEST(SplitPolygon, OnesWithoutAreaAreFans) {
  const PolygonSplit split = split_of(in_space({{0, 0}, {1, 0}, {3, 0}, {2, 0}}));
  EXPECT_FALSE(split.crosses_itself);
  EXPECT_EQ(split.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(SplitPolygon, OnesThatAreNotPlaneAreSaid) {
  const auto bent = [](float height) { return split_of({{0, 0, 0}, {1, 0, 0}, {1, 1, height}, {0, 1, 0}}); };
  EXPECT_TRUE(bent(0.01f).flat);
  EXPECT_FALSE(bent(0.1f).flat);
  EXPECT_FALSE(bent(0.1f).crosses_itself);
}

}  // namespace
}  // namespace vpm
