// Grids of OpenVDB's into files of ours: whole ones, and the same bytes for the same grids.
#pragma once

#include <functional>
#include <string>

#include "vpm/input/grid/vdb_grid.h"

namespace vpm {

/// The transform of an affine map of columns.
openvdb::math::Transform::Ptr transform_of(const Mat4d& index_to_world);

/// Writes the grids that `make` makes. The file appears whole or not at all. Throws InputError where the path cannot be
/// written, or the grids cannot be made.
void write_vdb(const std::function<openvdb::GridPtrVec()>& make, const std::string& path);

}  // namespace vpm
