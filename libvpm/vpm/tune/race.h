// Ways to render that race: each makes passes of a pilot, and those that are surely behind are dropped.
#pragma once

#include <string>
#include <vector>

#include "vpm/base/clock.h"
#include "vpm/integrators/integrator.h"

namespace vpm {

/// What won, with the radii and the number of photons that it chose, and why; with its default radii where the time
/// did not allow any way a pilot.
struct Winner {
  RenderSettings settings;
  std::vector<Choice> choices{};
  std::string reason{};
};
/// Takes about a fifth of the settings' seconds, or what one small pass of each way takes, if that is more, up to a
/// half of them. `ways` are not empty.
Winner race(const Scene& scene, const AutomaticSettings& automatic, const std::vector<Way>& ways, const Clock& clock);

}  // namespace vpm
