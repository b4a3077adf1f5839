// Density grids into .vdb files: the procedural fields, sampled, and arrays.
#pragma once

#include <string>

#include "vpm/input/grid/grid_values.h"

namespace vpm {

/// Samples the procedural field of that name with `resolution` voxels, 2 to 2048, along the longest edge of its box,
/// the outermost on its faces, and writes it to `path` as the sparse float fog volume `density`: centered at x = z = 0,
/// its base at y = 0, zeros left out. The same name and resolution give the same bytes. The file appears whole or not
/// at all. Throws InputError for an unknown name (listing those there are), a resolution out of range and a path that
/// cannot be written.
void write_media_grid(const std::string& name, int resolution, const std::string& path);

/// Writes the values to `path` as the sparse float fog volume `density`, zeros left out. The same values give the same
/// bytes. The file appears whole or not at all. Throws InputError for a transform that is not affine, and a path that
/// cannot be written.
void write_grid(const GridValues& values, const std::string& path);

}  // namespace vpm
