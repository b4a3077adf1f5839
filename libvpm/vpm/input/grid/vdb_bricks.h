// What a density grid is made of, read off a grid of OpenVDB's.
#pragma once

#include <memory>

#include "vpm/input/grid/vdb_grid.h"
#include "vpm/medium/grid/density_grid.h"

namespace vpm {

/// The densities of a tree of OpenVDB's in the frame's box; negative values are read as 0. The tree loses the leaves
/// that have been read on the way: where bricks lie in one box, memory never holds all of both. Throws InputError where
/// that takes more memory than a grid may.
std::shared_ptr<const DensityGrid> density_of(openvdb::FloatTree& tree, const GridFrame& frame);

}  // namespace vpm
