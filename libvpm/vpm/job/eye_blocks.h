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

inline constexpr size_t kEyeBlocks = 64;          // eight in either direction
inline constexpr size_t kRaysOfBlock = kEyeRays;  // of pixels in a square; in small pictures some are the same

/// Some rays of a block, to be followed together.
class RaysOfBlock {
 public:
  RaysOfBlock(const Camera& camera, size_t block, EyeCounters& counters, EyeScratch& scratch)
      : camera_(camera), block_(block), counters_(counters), scratch_(scratch) {}
  RaysOfBlock(const RaysOfBlock&) = delete;  // its rays refer to its random numbers
  RaysOfBlock& operator=(const RaysOfBlock&) = delete;

  /// Adds ray number `i` < kRaysOfBlock, through a place of its pixel that the camera's filter draws, up to that many
  /// times. Rays in a row lie side by side.
  void add(size_t i, const Rng& rng);
  std::span<EyeRay> all() { return rays_; }

 private:
  const Camera& camera_;
  size_t block_;
  EyeCounters& counters_;
  EyeScratch& scratch_;
  std::array<std::optional<Rng>, kRaysOfBlock> rngs_;
  std::vector<EyeRay> rays_;
};

}  // namespace vpm
