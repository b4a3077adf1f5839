// The stages of a render in words.
#pragma once

#include <string>
#include <vector>

#include "vpm/integrators/photon_map/plan.h"

namespace vpm {

/// Which of the stages run, of a render or a light map, which are skipped, and why: one line each, "runs ..." or
/// "skips ...". `shown`: what of the scene's scattering the picture shows.
std::vector<std::string> stage_lines(const Scene& scene, const RenderSettings& settings, const Scattering& shown);

}  // namespace vpm
