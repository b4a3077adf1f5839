// The ways to render that settings and a scene allow, where some components are to be chosen.
#pragma once

#include <string>
#include <vector>

#include "vpm/integrators/integrator.h"

namespace vpm {

/// And what is wrong with the others: "; not NAME: WHY", or "".
struct OpenWays {
  std::vector<Way> ways;
  std::string refused;
};
OpenWays open_ways(const Scene& scene, const AutomaticSettings& automatic, const RenderSettings& settings);

}  // namespace vpm
