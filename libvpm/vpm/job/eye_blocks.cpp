// Blocks around the middles of the parts that a grid cuts the picture into.
#include "vpm/job/eye_blocks.h"

#include <algorithm>

namespace vpm {
namespace {

constexpr size_t kBlocksOfEdge = 8, kPixelsOfEdge = 8;
static_assert(kBlocksOfEdge * kBlocksOfEdge == kEyeBlocks && kPixelsOfEdge * kPixelsOfEdge == kRaysOfBlock);

/// A pixel along an edge of the picture; in small pictures some are the same.
int pixel_along(int pixels, size_t part, size_t i) {
  const size_t middle = (2 * part + 1) * static_cast<size_t>(pixels) / (2 * kBlocksOfEdge);
  return std::clamp(static_cast<int>(middle + i) - static_cast<int>(kPixelsOfEdge / 2), 0, pixels - 1);
}

}  // namespace

BlockRay ray_of_block(const Camera& camera, size_t block, size_t i, const Vec2& u) {
  const int x = pixel_along(camera.width, block % kBlocksOfEdge, i % kPixelsOfEdge);
  const int y = pixel_along(camera.height, block / kBlocksOfEdge, i / kPixelsOfEdge);
  const Vec2 place = Vec2(x, y) + 0.5f + sample_filter(camera.filter, u);
  return {camera.ray(place), static_cast<size_t>(y) * static_cast<size_t>(camera.width) + static_cast<size_t>(x)};
}

}  // namespace vpm
