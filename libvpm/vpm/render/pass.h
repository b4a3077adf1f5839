// What one pass over the pixels gives, and where it tells how far it is.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/base/progress.h"
#include "vpm/estimate/statistics.h"
#include "vpm/image/image.h"

namespace vpm {

struct Pass {
  Image image;                   // radiance, W/(m^2 sr)
  float relative_square = 0.0f;  // squared radius of the maps' kernels over that of the first pass; 0: no kernel
  int bias_order = 0;            // its bias goes with this power of the radius, see bias_order()
  std::vector<uint64_t> found;   // photons in each pixel's disc, over its samples, where pixels have discs of their own
  RenderStatistics statistics;
};

/// Where a pass tells how far it is. Either may be missing.
struct PassProgress {
  bool stages = false;        // a bar for each stage of the pass
  Progress* tiles = nullptr;  // advanced by the pass's units of work in its course
};

}  // namespace vpm
