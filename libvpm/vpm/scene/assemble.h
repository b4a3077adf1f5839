// The way from parts to a scene, with every check: who builds scenes in code and who reads them from files are its
// clients.
#pragma once

#include <string>
#include <vector>

#include "vpm/scene/parts.h"

namespace vpm {

struct AssembledScene {
  Scene scene;                           // finished
  std::vector<std::string> light_names;  // of Scene::lights: those of the shapes that emit; empty where none is given
  std::vector<std::string> notes;        // what a user should know of: possible, but suspicious
};

/// Puts the parts together: Scene's lists in the order of the parts', followed by the boxes of grids that no shape
/// bounds; shapes that emit follow the other lights. A material with a texture gets the picture's mean as reflectance.
/// Throws PartError, which names the part: for what check_parts.h refuses, for shapes that Geometry does,
/// for grids with a background where a box ends them or without one where they fill the world, for lights at
/// infinity with nothing to shine on, for lights whose power in all is 0 or infinite, for shapes that contradict each
/// other about the media around them, and for dielectrics with a common face.
AssembledScene assemble(SceneParts parts);

}  // namespace vpm
