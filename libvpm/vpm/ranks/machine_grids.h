// The grids of a scene, once for all ranks of a machine: the first of them reads them, and the others look them
// up where it has put them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <system_error>

#include "vpm/medium/grid/density_grid.h"
#include "vpm/ranks/ranks.h"
#include "vpm/scene/scene.h"

namespace vpm {

using GridsOfScene = std::map<GridName, std::shared_ptr<const DensityGrid>>;

/// By rank 0 of a machine, once it has read the scene: moves the scene's grids into memory that all of the machine's
/// ranks share, and sends the others word. Where the system refuses such memory, it returns why; the scene then keeps
/// its own grids, and so do the others.
std::error_code share_grids(Ranks& machine, Scene& scene);

/// By the others: waits for the grids that are shared. Nothing where rank 0 shares none, so that each is to read its
/// own. Throws std::system_error where what is shared cannot be had, and InputError where rank 0 is another vpm.
std::optional<GridsOfScene> shared_grids(Ranks& machine);

}  // namespace vpm
