// Rays of blocks of pixels all over the picture: a pilot takes them for those of all pixels.
#pragma once

#include <cstddef>

#include "vpm/scene/camera.h"

namespace vpm {

inline constexpr size_t kEyeBlocks = 64;    // eight in either direction
inline constexpr size_t kRaysOfBlock = 64;  // of as many pixels in a square; in small pictures some are the same

/// A ray, and the pixel that it belongs to, numbered row by row.
struct BlockRay {
  Ray ray;
  size_t pixel;
};
/// Ray number `i` < kRaysOfBlock of a block, through a place of its pixel that the camera's filter draws.
BlockRay ray_of_block(const Camera& camera, size_t block, size_t i, const Vec2& u);

}  // namespace vpm
