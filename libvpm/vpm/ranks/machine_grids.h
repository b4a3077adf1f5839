// The density grids of a scene, once for all ranks of a machine: the first of them reads them, and the others look them
// up where it has put them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "vpm/medium/density_grid.h"
#include "vpm/ranks/ranks.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Grids of media, by their names.
using GridsOfMedia = std::map<std::string, std::shared_ptr<const DensityGrid>>;

/// By the rank that leads the machine, once it has read the scene: moves the scene's grids into memory that all of its
/// ranks share, and tells the others. Where there is no room for them, the scene keeps its own, the others are told,
/// too, and it throws std::system_error.
void share_grids(Machine& machine, Scene& scene);

/// By the others, before they read the scene: the grids that are shared. Nothing where the first shares none, so that
/// each rank is to read its own. Throws std::system_error where what is shared cannot be had.
std::optional<GridsOfMedia> shared_grids(Machine& machine);

}  // namespace vpm
