// The JSON report of a render or of a light map: provenance, times, counts and the energy ledger, each with its unit.
#pragma once

#include <string>

#include "vpm/job/bake.h"
#include "vpm/job/render_job.h"
#include "vpm/render/render.h"

namespace vpm {

/// The report as JSON text. `image` is the path of the image it belongs to.
std::string render_report(const RenderJob& job, const std::string& image, const RenderResult& result);

/// The same of a light map of the shape named `mesh`.
std::string light_map_report(const RenderJob& job, const std::string& image, const std::string& mesh,
                             const UvLayout& layout, const LightMap& baked);

}  // namespace vpm
