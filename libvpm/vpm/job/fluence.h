// Fields inside media: fluence and absorbed power in the cells of a box, in passes, with standard errors.
#pragma once

#include <filesystem>
#include <vector>

#include "vpm/job/photon_passes.h"
#include "vpm/photon/cell_lattice.h"

namespace vpm {

/// Means over passes and over each cell, by the number of the cell. Errors are standard errors of the mean; NaN of a
/// single pass.
struct FluenceField {
  CellLattice lattice;
  PhotonPasses run;
  std::vector<Rgb> fluence, absorbed;  // W/m^2, in media; W/m^3
  std::vector<Rgb> fluence_error, absorbed_error;
};

/// A box in about cubes, `resolution` >= 1 along its longest edge.
CellLattice about_cubes(const Box& box, int resolution);

/// Traces passes of photons. Throws as check_photon_passes() does, and InputError where the cells do not fit into the
/// memory of the machine, or where there is no light.
FluenceField measure_fluence(const Scene& scene, const RenderSettings& settings, const CellLattice& lattice,
                             const PhotonRun& run);

/// Throws InputError where a file could not be written: an extension other than .npy, a missing folder.
void check_field_file(const std::filesystem::path& path);
/// Writes an array of numpy's of shape (x, y, z, 4, 3) and type float32: of each cell fluence, its error, absorbed
/// power and its error, each in three channels.
void write_field(const FluenceField& field, const std::filesystem::path& path);

}  // namespace vpm
