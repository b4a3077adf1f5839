// Fields inside media: fluence and absorbed power in the cells of a box, in passes, with standard errors.
#pragma once

#include <array>
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
  bool grey = false;                   // the channels of the scene are the same
  std::vector<Rgb> fluence, absorbed;  // W/m^2, in media; W/m^3
  std::vector<Rgb> fluence_error, absorbed_error;
  std::array<std::vector<Rgb>, 3> flux, flux_error;  // net flux along x, y and z in media, W/m^2; empty: not asked for
};

/// The box around the scene's shapes, where that has a volume.
Box default_field_box(const Scene& scene);
/// A box in about cubes, `resolution` >= 1 along its longest edge.
CellLattice about_cubes(const Box& box, int resolution);

/// Traces passes of photons. Throws as check_photon_passes() does, and InputError where the cells do not fit into the
/// memory of the machine, or where there is no light.
FluenceField measure_fluence(const Scene& scene, const RenderSettings& settings, const CellLattice& lattice,
                             const PhotonRun& run, bool flux = false);

/// Writes an array of numpy's of shape (x, y, z, 4, 3) and type float32: of each cell fluence, its error, absorbed
/// power and its error, each in three channels. With flux it is (x, y, z, 10, 3): those along x, y and z, each with its
/// error, come behind.
void write_npy(const FluenceField& field, const std::filesystem::path& path);

}  // namespace vpm
