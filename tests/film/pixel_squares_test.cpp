// The order of pixels where one of each square gathers for all.
#include "vpm/film/pixel_squares.h"

#include <gtest/gtest.h>

#include <map>

#include "vpm/estimate/eye_work.h"

namespace vpm {
namespace {

struct Seen {
  std::map<std::pair<int, int>, int> pixels;  // how often each is
  size_t bundles = 0, leading = 0;
};

/// Looks at the order of each tile that meets the rectangle.
Seen look_at(const PixelRect& pixels, const glm::ivec2& size, const PixelSquares& squares) {
  Seen seen;
  for (const glm::ivec2& corner : squares.tiles_in(pixels)) {
    const PixelOrder order(corner, size, squares);
    const auto items = order.items();
    std::map<int, glm::ivec2> leaders;
    size_t begin = 0;
    for (const size_t end : order.ends()) {
      EXPECT_LE(end - begin, kEyeRays);
      for (size_t i = begin; i < end; ++i) EXPECT_EQ(items[i].leads, items[begin].leads);
      begin = end;
    }
    EXPECT_EQ(begin, items.size());
    seen.bundles += order.ends().size();
    for (const PixelOrder::Item& item : items) {
      const glm::ivec2 p = item.pixel, place = (p - squares.first) % squares.edge;
      EXPECT_TRUE(p.x >= 0 && p.y >= 0 && p.x < size.x && p.y < size.y);
      ++seen.pixels[{p.x, p.y}];
      EXPECT_EQ(item.leads, place == squares.leader);
      if (item.leads) {
        EXPECT_TRUE(leaders.emplace(item.square, p).second);
        ++seen.leading;
      } else if (item.square >= 0) {
        EXPECT_TRUE(leaders.contains(item.square));  // it is followed before
        EXPECT_EQ(leaders[item.square] - squares.leader, p - place);
      } else {
        const glm::ivec2 leader = p - place + squares.leader;
        EXPECT_TRUE(leader.x < 0 || leader.y < 0 || leader.x >= size.x || leader.y >= size.y);
      }
    }
  }
  return seen;
}

TEST(PixelOrder, HasEachPixelOnceBehindTheOneThatGathersForIt) {
  for (int edge = 1; edge <= 4; ++edge)
    for (int x = 0; x < edge; ++x)
      for (int leader = 0; leader < edge; ++leader) {
        const PixelSquares squares{edge, {-x, x - edge + 1}, {leader, edge - 1 - leader}};
        const Seen all = look_at({0, 0, 37, 21}, {37, 21}, squares);
        EXPECT_EQ(all.pixels.size(), 37u * 21u);
        for (const auto& [pixel, times] : all.pixels) EXPECT_EQ(times, 1);
        const Seen part = look_at({16, 5, 18, 21}, {37, 21}, squares);
        for (int v = 5; v < 21; ++v)
          for (int u = 16; u < 18; ++u) EXPECT_EQ(part.pixels.count({u, v}), 1u);
        EXPECT_LT(part.pixels.size(), all.pixels.size());
      }
}

TEST(PixelOrder, HasOneThatGathersForEachSquare) {
  const Seen seen = look_at({0, 0, 64, 64}, {64, 64}, {2, {0, 0}, {1, 0}});
  EXPECT_EQ(seen.leading, 32u * 32u);
  EXPECT_EQ(seen.bundles, 64u);
}

TEST(PixelSquares, AreDrawnEvenly) {
  std::map<std::pair<int, int>, int> places;
  constexpr int kDraws = 16'000;
  for (int i = 0; i < kDraws; ++i) {
    const PixelSquares squares = PixelSquares::draw(4, Rng(3, rng_stream(RngUse::test, 0), static_cast<uint64_t>(i)));
    ASSERT_TRUE(squares.first.x <= 0 && squares.first.x > -4 && squares.leader.y >= 0 && squares.leader.y < 4);
    ++places[{squares.first.x, squares.leader.y}];
  }
  // 16 counts of 1000 +- 31: none is 5 standard deviations off in all but one of 100,000 runs.
  EXPECT_EQ(places.size(), 16u);
  for (const auto& [place, times] : places) EXPECT_NEAR(times, 1000, 155);
}

}  // namespace
}  // namespace vpm
