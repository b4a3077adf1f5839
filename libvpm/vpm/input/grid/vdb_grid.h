// Grids of OpenVDB's that its library makes. Where a file of ours constructs one, or calls a virtual function of a
// tree by its own type, the whole class is compiled there again, which takes half a minute.
#pragma once

#include <openvdb/openvdb.h>

#include "vpm/base/vec.h"

namespace vpm {

/// An empty FloatGrid or DoubleGrid, of background 0. openvdb::initialize() comes before it.
template <class Grid>
typename Grid::Ptr new_grid() {
  return openvdb::gridPtrCast<Grid>(openvdb::GridBase::createGrid(Grid::gridType()));
}

inline Vec3i to_vec(const openvdb::Coord& voxel) { return {voxel.x(), voxel.y(), voxel.z()}; }

}  // namespace vpm
