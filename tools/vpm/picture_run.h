// What vpm render and vpm view have in common: a job is rendered to a picture, a preview and a report.
#pragma once

#include <string>
#include <vector>

#include "commands.h"
#include "pass_run.h"
#include "vpm/job/render_job.h"

namespace vpm::tools {

/// The options that change keys of a scene file, as --set options.
std::vector<std::string> overrides_of(const RenderOptions& options);

/// Renders a job as the options say, which have changed its scene already. Returns the exit status.
int render_picture(const RenderOptions& options, const Outputs& outputs, RenderJob job);

}  // namespace vpm::tools
