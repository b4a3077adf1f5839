// Photon maps as an integrator.
#pragma once

#include <string>
#include <vector>

#include "vpm/estimate/statistics.h"
#include "vpm/integrators/settings.h"
#include "vpm/scene/scene_facts.h"

namespace vpm {

class Description;

void describe_photon_maps(RenderSettings& settings, Description& description);
void check_photon_maps(const RenderSettings& settings, const SceneFacts& facts);
std::vector<std::string> stages_of_photon_maps(const Scene& scene, const RenderSettings& settings,
                                               const SceneFacts& shown);
std::vector<std::string> warnings_of_photon_maps(const SceneFacts& shown, const RenderSettings& settings,
                                                 const RenderStatistics& statistics);

}  // namespace vpm
