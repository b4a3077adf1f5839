// Settings that a newcomer can leave alone: a render chooses them.
#pragma once

#include <string>
#include <vector>

#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"
#include "vpm/tune/choice.h"

namespace vpm {

/// What was chosen, and what was not for want of time and has its default: a sentence, or "".
struct Chosen {
  std::vector<Choice> choices;
  std::string not_chosen;
};

/// Chooses what is asked for, after a short pilot, and puts it into the settings. What is chosen is a pure function of
/// scene and settings, on any machine and number of threads: costs are counted, not timed. Only where a time is asked
/// for, passes are timed: then the numbers of photons, the gather in media, the integrator, and the radii that go by
/// these depend on the machine. What takes more than its part of `time` is given up. What the scene has no use for is
/// left alone. Throws InputError where this program counts nothing (VPM_COUNTERS=OFF) and a strategy is asked for.
Chosen choose_settings(const Scene& scene, const AutomaticSettings& automatic, const ChoosingTime& time,
                       RenderSettings& settings);

/// Puts a choice made earlier into the settings. Throws InputError where it is none: a setting that is not
/// Setting::automatic, or a value that is not of its domain, or 0.
void set_chosen(RenderSettings& settings, const std::string& key, const std::string& value);

}  // namespace vpm
