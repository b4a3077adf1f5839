// Fields into files: of numpy's, and of OpenVDB's.
#pragma once

#include <filesystem>

#include "vpm/job/fluence.h"

namespace vpm {

/// Throws InputError where a file could not be written: an extension other than .npy and .vdb, a missing folder.
void check_field_file(const std::filesystem::path& path);

/// As write_npy(); or in a .vdb the grids `fluence` and `absorbed`, and where it was asked for `flux`, vectors in
/// space; of scenes that are not grey one for each channel: `fluence_r` and so on; of several passes with their errors,
/// `fluence_error_r`. Voxels lie at the cells' centers.
void write_field(const FluenceField& field, const std::filesystem::path& path);

}  // namespace vpm
