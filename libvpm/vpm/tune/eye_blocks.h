// Rays of blocks of pixels all over the picture: a pilot takes them for those of all pixels.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "vpm/estimate/eye_work.h"
#include "vpm/scene/camera.h"

namespace vpm {

inline constexpr size_t kEyeBlocks = 64;  // parts of the picture, eight in either direction
/// Eight in either direction; in small pictures some pixels are the same.
inline constexpr size_t kRaysOfBlock = kEyeRays;

/// Which pixels of its part of the picture a block has: those in the middle, side by side as rays of a picture are
/// followed, which show what these cost; or evenly spread ones, which see all edges of light.
enum class BlockPixels { side_by_side, spread };

/// Some rays of a block, to be followed together.
class RaysOfBlock {
 public:
  RaysOfBlock(const Camera& camera, size_t block, BlockPixels pixels, EyeCounters& counters, EyeScratch& scratch)
      : camera_(camera), block_(block), pixels_(pixels), counters_(counters), scratch_(scratch) {}
  RaysOfBlock(const RaysOfBlock&) = delete;  // its rays refer to its random numbers
  RaysOfBlock& operator=(const RaysOfBlock&) = delete;

  /// Adds ray number `i` < kRaysOfBlock, through a place of its pixel that the camera's filter draws, up to that many
  /// times. Rays in a row lie near each other.
  void add(size_t i, Rng rng) { add(i, rng.uniform2(), rng); }
  /// The same where the filter draws by numbers that are given, in [0, 1).
  void add(size_t i, const Vec2& place, const Rng& rng);
  std::span<EyeRay> all() { return rays_; }

 private:
  const Camera& camera_;
  size_t block_;
  BlockPixels pixels_;
  EyeCounters& counters_;
  EyeScratch& scratch_;
  std::array<std::optional<Rng>, kRaysOfBlock> rngs_;
  std::vector<EyeRay> rays_;
};

}  // namespace vpm
