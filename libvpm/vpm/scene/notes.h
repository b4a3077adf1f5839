// What a user should know of a scene: possible, but more than single precision resolves.
#pragma once

#include <string>
#include <vector>

#include "vpm/scene/scene.h"

namespace vpm {

/// Sentences about a finished scene: that it stands so far from the origin that the spacing of floats there shows in
/// its shapes, and which media have free paths shorter than floats resolve positions.
std::vector<std::string> notes_of(const Scene& scene);

}  // namespace vpm
