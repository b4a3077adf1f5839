// Pieces of a render add up to the sums of one run, to the last bit.
#include "vpm/job/pieces.h"

#include <gtest/gtest.h>

#include "vpm/base/error.h"
#include "vpm/base/rng.h"

namespace vpm {
namespace {

/// Passes of a range of 5 x 3 pixels of random values, with one layer.
RenderResult passes(int first, int end) {
  RenderResult result{Film(5, 3), {}, 0.5 * (end - first), {}, {}, {Film(5, 3)}};
  for (int pass = first; pass < end; ++pass) {
    Image image(5, 3), layer(5, 3);
    Rng rng(8, static_cast<uint64_t>(pass), 0);
    for (size_t i = 0; i < image.pixels.size(); ++i) {
      image.pixels[i] = Rgb(rng.uniform(), 1e9f * rng.uniform(), 1e-9f * rng.uniform());
      layer.pixels[i] = Rgb(rng.uniform());
    }
    result.film.add(pass, image, layer);
    result.layers[0].add(pass, layer);
    result.statistics.eye.rays += 15;
    ++result.statistics.passes;
  }
  return result;
}

TEST(Pieces, AddUpToOneRunInAnyOrder) {
  const RenderResult whole = passes(0, 9);
  for (const auto& order : {std::vector<PassRange>{{6, 9}, {0, 1}, {1, 6}}, {{0, 4}, {4, 5}, {5, 9}}}) {
    RenderResult sum = passes(order[0].first, order[0].end);
    sum.errors = whole.film.errors();
    for (size_t i = 1; i < order.size(); ++i) add_piece(sum, passes(order[i].first, order[i].end));
    EXPECT_EQ(sum.film.sums(), whole.film.sums());
    EXPECT_EQ(sum.layers[0].sums(), whole.layers[0].sums());
    EXPECT_FALSE(sum.errors) << "those of a piece are not those of the whole";
    EXPECT_EQ(sum.seconds, whole.seconds);
    EXPECT_EQ(sum.statistics.eye.rays, whole.statistics.eye.rays);
    EXPECT_EQ(sum.statistics.passes, 9);
  }
}

TEST(Pieces, ThatDoNotBelongTogetherAreRefused) {
  RenderResult whole = passes(0, 2);
  EXPECT_THROW(add_piece(whole, passes(1, 3)), InputError);
  RenderResult piece = passes(2, 3);
  piece.layers.clear();
  EXPECT_THROW(add_piece(whole, piece), InputError);
  EXPECT_THROW(add_piece(whole, {Film(5, 4), {}, 0.0, {}, {}, {Film(5, 4)}}), InputError);
  piece = passes(2, 3);
  piece.discs.resize(15);
  EXPECT_THROW(add_piece(whole, piece), InputError);
  piece.discs.clear();
  EXPECT_NO_THROW(add_piece(whole, piece));
}

TEST(Pieces, AreToldByTheNumbersOfTheirPasses) {
  EXPECT_EQ(passes_text(PassSet{}), "none");
  EXPECT_EQ(passes_text(PassSet({{0, 64}, {70, 71}})), "0 to 63, 70");
  EXPECT_EQ(missing_passes(PassSet({{0, 64}})).count(), 0);
  EXPECT_EQ(missing_passes(PassSet({{2, 4}, {5, 8}})).ranges(), (std::vector<PassRange>{{0, 2}, {4, 5}}));
  EXPECT_EQ(missing_passes(PassSet{}).count(), 0);
}

}  // namespace
}  // namespace vpm
