// A grid cuts the picture into parts, and has a block of each.
#include "vpm/tune/eye_blocks.h"

#include <algorithm>

namespace vpm {
namespace {

constexpr size_t kBlocksOfEdge = 8, kPixelsOfEdge = 8, kPixelsOfSquare = 4;
constexpr size_t kSquaresOfEdge = kPixelsOfEdge / kPixelsOfSquare;
static_assert(kPixelsOfSquare * kPixelsOfSquare == kBlock);
static_assert(kBlocksOfEdge * kBlocksOfEdge == kEyeBlocks && kPixelsOfEdge * kPixelsOfEdge == kRaysOfBlock);

/// A pixel along an edge of the picture; in small pictures some are the same.
int pixel_along(int pixels, BlockPixels which, size_t part, size_t i) {
  constexpr size_t kAll = 2 * kBlocksOfEdge * kPixelsOfEdge;
  if (which == BlockPixels::spread)
    return static_cast<int>((2 * (part * kPixelsOfEdge + i) + 1) * static_cast<size_t>(pixels) / kAll);
  const size_t middle = (2 * part + 1) * static_cast<size_t>(pixels) / (2 * kBlocksOfEdge);
  return std::clamp(static_cast<int>(middle + i) - static_cast<int>(kPixelsOfEdge / 2), 0, pixels - 1);
}

}  // namespace

void RaysOfBlock::add(size_t i, const Vec2& place, const Rng& random) {
  // Squares of kBlock pixels one after another.
  const size_t square = i / kBlock, within = i % kBlock;
  const size_t column = square % kSquaresOfEdge * kPixelsOfSquare + within % kPixelsOfSquare;
  const size_t row = square / kSquaresOfEdge * kPixelsOfSquare + within / kPixelsOfSquare;
  const int x = pixel_along(camera_.width, pixels_, block_ % kBlocksOfEdge, column);
  const int y = pixel_along(camera_.height, pixels_, block_ / kBlocksOfEdge, row);
  Rng& rng = rngs_[rays_.size()].emplace(random);
  const Vec2 through = Vec2(x, y) + 0.5f + sample_filter(camera_.filter, place);
  const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(camera_.width) + static_cast<size_t>(x);
  rays_.push_back({camera_.ray(through), {rng, counters_, scratch_, pixel}});
}

}  // namespace vpm
