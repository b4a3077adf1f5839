// What one pass over the pixels gives, and where it tells how far it is.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/base/progress.h"
#include "vpm/estimate/statistics.h"
#include "vpm/image/image.h"
#include "vpm/photon/kernel.h"

namespace vpm {

struct Pass {
  Image image;                  // radiance, W/(m^2 sr)
  Image correction;             // what would take away a bias of its kernels that goes as r^2 (KernelPair)
  std::vector<Image> layers;    // layer_films() of them: parts of the radiance, then what the camera sees
  std::vector<uint64_t> found;  // photons in each pixel's disc, over its samples, where pixels have discs of their own
  RenderStatistics statistics;

  /// Black.
  Pass(int width, int height) : image(width, height), correction(width, height) { statistics.passes = 1; }
  void set(int x, int y, const KernelEstimate& pixel) {
    image.at(x, y) = pixel.value;
    correction.at(x, y) = pixel.correction;
  }
};

/// Where a pass tells how far it is. Either may be missing.
struct PassProgress {
  bool stages = false;        // a bar for each stage of the pass
  Progress* tiles = nullptr;  // advanced by the pass's units of work in its course
};

}  // namespace vpm
