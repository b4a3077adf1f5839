// Messages about a render, in words.
#pragma once

#include <string>
#include <vector>

#include "vpm/job/render_job.h"
#include "vpm/render/render.h"

namespace vpm {

/// What went wrong in a render without stopping it, a sentence each.
std::vector<std::string> warnings_of(const RenderJob& job, const RenderResult& result);
/// The same of a light map, which shows no media.
std::vector<std::string> warnings_of_light_map(const RenderJob& job, const RenderResult& result);

/// The same of photons alone: those that were dropped or cut, whose power is missing.
std::vector<std::string> warnings_of(const Ledger& ledger);

/// The estimated error; "" where passes are too few.
std::string error_text(const RenderJob& job, const RenderResult& result);

}  // namespace vpm
