// Parts of a scene that its maker holds in memory, where a scene file would name files.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "vpm/input/grid/grid_values.h"
#include "vpm/medium/medium.h"
#include "vpm/surface/geometry.h"

namespace vpm {

struct GivenParts {
  std::map<GridName, GridValues> grids;
  std::map<size_t, TriangleMesh> meshes;  // of shapes, by their numbers in [[shapes]]

  const GridValues* grid(const GridName& name) const {
    const auto found = grids.find(name);
    return found == grids.end() ? nullptr : &found->second;
  }
  const TriangleMesh* mesh(size_t shape) const {
    const auto found = meshes.find(shape);
    return found == meshes.end() ? nullptr : &found->second;
  }
};

}  // namespace vpm
