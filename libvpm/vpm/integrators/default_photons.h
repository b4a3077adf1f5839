// The number of photons of a pass by what photons and rays from the eye count.
#pragma once

#include <optional>

#include "vpm/integrators/choice.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// As many photons as have as many rays and look-ups as those from the eye, where their number is to be chosen, is put
/// into the settings: a pure function of scene and settings. Nothing where there are none, or nothing is counted.
std::optional<Choice> choose_default_photons(const Scene& scene, const AutomaticSettings& automatic,
                                             RenderSettings& settings);

}  // namespace vpm
