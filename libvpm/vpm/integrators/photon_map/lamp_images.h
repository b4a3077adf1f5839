// Where the camera sees lamps by way of mirrors and glass.
//
// Such an image of a lamp may be smaller than a pixel and a thousand times as bright: one ray a pass finds it seldom,
// and that one pixel has most of the error of a picture. So some rays look for these pixels once, before the first
// pass. In those that were found, rays that gather nothing see lamps in the place of the ray that does.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/scene/scene.h"

namespace vpm {

class LampImages {
 public:
  /// Looks for them by a few rays through each pixel, where the scene has both lamps and what shows them.
  LampImages(const Scene& scene, uint64_t seed, int max_events);

  /// The rays by which each pass sees lamps in a pixel whose neighbourhood shows them unevenly.
  static constexpr uint32_t kRays = 16;
  bool in(size_t pixel) const { return !marked_.empty() && marked_[pixel] != 0; }

 private:
  std::vector<uint8_t> marked_;  // by pixel; empty: nowhere
};

}  // namespace vpm
