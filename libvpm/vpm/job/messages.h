// What a person is told of a render in words.
#pragma once

#include <string>
#include <vector>

#include "vpm/job/render.h"
#include "vpm/job/render_job.h"
#include "vpm/render/plan.h"

namespace vpm {

/// What went wrong without stopping the run, a sentence each. `shown`: what of the scene's scattering the picture
/// shows.
std::vector<std::string> warnings_of(const Scattering& shown, const RenderSettings& settings,
                                     const RenderStatistics& statistics);

/// The error that the passes are estimated to have, as far as they tell; "" where they are too few.
std::string error_text(const RenderJob& job, const RenderResult& result);

}  // namespace vpm
