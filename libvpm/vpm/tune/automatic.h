// Settings that a newcomer can leave alone: a render chooses them.
#pragma once

#include <string>
#include <vector>

#include "vpm/base/clock.h"
#include "vpm/integrators/choice.h"
#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Chooses what is asked for, and puts it into the settings. Where they ask for a time, passes of a pilot are timed and
/// compared: what is chosen then depends on the machine. Else the integrator and its components stay, and what is
/// chosen is a pure function of scene and settings, on any machine and number of threads. What the scene has no use for
/// is left alone. Throws InputError where no way to render is open.
std::vector<Choice> choose_settings(const Scene& scene, const AutomaticSettings& automatic, const Clock& clock,
                                    RenderSettings& settings);

}  // namespace vpm
