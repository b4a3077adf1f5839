// Blocks around the middles of the parts that a grid cuts the picture into.
#include "vpm/job/eye_blocks.h"

#include <algorithm>
#include <cmath>

namespace vpm {
namespace {

constexpr size_t kBlocksOfEdge = 8, kPixelsOfEdge = 8;
static_assert(kBlocksOfEdge * kBlocksOfEdge == kEyeBlocks && kPixelsOfEdge * kPixelsOfEdge == kRaysOfBlock);

/// A place along an edge of the picture, the middle of a pixel; cut off at the borders of small pictures.
float place_along(int pixels, size_t part, size_t i) {
  const float middle = std::floor(static_cast<float>(pixels) * (static_cast<float>(part) + 0.5f) / kBlocksOfEdge);
  const float place = middle + static_cast<float>(i) - 0.5f * kPixelsOfEdge + 0.5f;
  return std::clamp(place, 0.5f, static_cast<float>(pixels) - 0.5f);
}

}  // namespace

BlockRay ray_of_block(const Camera& camera, size_t block, size_t i) {
  const float x = place_along(camera.width, block % kBlocksOfEdge, i % kPixelsOfEdge);
  const float y = place_along(camera.height, block / kBlocksOfEdge, i / kPixelsOfEdge);
  const int column = std::min(static_cast<int>(x), camera.width - 1);
  const int row = std::min(static_cast<int>(y), camera.height - 1);
  return {camera.ray({x, y}), static_cast<size_t>(row) * static_cast<size_t>(camera.width) + column};
}

}  // namespace vpm
