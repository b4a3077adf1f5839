// What is asked of a scene's parts before they are put together: their numbers, and what they say of each other.
#pragma once

#include "vpm/scene/parts.h"

namespace vpm {

/// Throws PartError for the first part that is refused: numbers out of their ranges, media and materials that are not
/// in the lists, two shapes of one name, a texture where there are no coordinates in it, emission of a boundary or
/// without any light, a light at infinity in a medium that fills the world, no light at all. Asks nothing of grids,
/// which may be missing still, nor of the vertices of meshes.
void check_parts(const SceneParts& parts);

/// Is the grid medium of that number met within a box of its own, rather than within the scene's shapes? Throws
/// PartError where shapes and the medium's boundary contradict each other.
bool is_boxed(const SceneParts& parts, MediumId medium);

}  // namespace vpm
