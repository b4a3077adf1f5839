// Extinction that depends on depth alone, as media that represent it exactly.
#pragma once

#include <vector>

#include "vpm/medium/medium.h"

namespace vpm {

/// Depth is measured downwards, against y, from y = 0. The extinction is linear between the nodes, with a jump where a
/// depth stands twice.
struct Layers {
  std::vector<double> depth;    // m, ascending from 0
  std::vector<double> sigma_t;  // 1/m, at the nodes

  double thickness() const { return depth.back(); }
};

/// Media of extinction only, from the top down, and the depth where each ends, m. Steps are one medium, a grid of
/// nearest voxels; otherwise every part without a jump is one: homogeneous, or a grid of trilinear voxels. Grids
/// are centered and reach `width` m to either side. Throws InputError where the nodes of a part lie
/// on no common lattice.
struct LayeredMedia {
  std::vector<Medium> media;
  std::vector<double> bottoms;
};
LayeredMedia layered_media(const Layers& layers, double width);

}  // namespace vpm
