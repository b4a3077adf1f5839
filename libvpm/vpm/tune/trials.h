// Ways to render that are tried, and of which the one that leaves the least error is chosen.
#pragma once

#include <string>
#include <vector>

#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"
#include "vpm/tune/choice.h"

namespace vpm {

/// Are the integrator, the gather in media or the combined techniques to be chosen, where there are such? Throws
/// InputError where a gather is to be chosen beside combined techniques, which have none.
bool asks_for_trials(const Scene& scene, const AutomaticSettings& automatic, const RenderSettings& settings);

/// choose_records(), and then scale_records(), as far as the time allows; where it allows neither, default radii.
/// Returns what it does not allow: a sentence, or "".
std::string choose_and_scale_records(const Scene& scene, const AutomaticSettings& automatic, const ChoosingTime& time,
                                     RenderSettings& settings, std::vector<Choice>& choices);

/// Tries each way that the settings and the scene allow: chooses what else is to be chosen for it, measures what a pass
/// costs and what error it leaves, and compares errors after the time of the render, or else after that of the least
/// number of the longest passes. Puts the best one into the settings, or the first where none can be measured by the
/// end of the time. Throws InputError where nothing is allowed.
std::vector<Choice> choose_by_trials(const Scene& scene, const AutomaticSettings& automatic, const ChoosingTime& time,
                                     RenderSettings& settings);

}  // namespace vpm
