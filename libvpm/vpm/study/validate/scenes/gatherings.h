// Ways to gather photons, and sets of techniques combined, that must agree on a picture.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "vpm/integrators/settings.h"

namespace vpm {

using NamedSettings = std::vector<std::pair<std::string, RenderSettings>>;

/// How a map can be asked: of media in both forms; with direct light by photons and by shadow rays.
NamedSettings forms(const RenderSettings& base, bool media);
/// Sets of techniques that find all light together: each technique in one that has few others; where not `many`, those
/// that have the fewest, and all but long beams, which not all media have.
void append_combined(NamedSettings& all, const RenderSettings& base, bool media, bool surfaces, bool many);
/// The ways of gathering: in all forms, also with single scattering at drawn distances; with k nearest; in media along
/// rays; from photons that are guided; on surfaces corrected at borders, and by final gathering, whose rays are guided
/// or not.
NamedSettings gatherings(const RenderSettings& base, bool media, bool surfaces, bool many_sets);

}  // namespace vpm
