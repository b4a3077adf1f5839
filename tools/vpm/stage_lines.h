// The stages of a render in words.
#pragma once

#include <string>
#include <vector>

#include "vpm/render/photon_pass.h"

namespace vpm::tools {

/// Which of the stages run, of a render or a light map, which are skipped, and why: one line each, "runs ..." or
/// "skips ...".
std::vector<std::string> stage_lines(const Scene& scene, const RenderSettings& settings, const Stages& stages);

}  // namespace vpm::tools
