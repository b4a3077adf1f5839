// What vpm render left behind: a JSON report, and the picture beside it that it belongs to.
#pragma once

#include <filesystem>

#include "json.h"
#include "vpm/image/exr.h"
#include "vpm/integrators/settings.h"

namespace vpm::tools {

struct RenderReport {
  Json json;                // render_report(): every section that has
  RenderSettings settings;  // those that decide what passes estimate; the others are the defaults
  ExrChannels picture;      // of these very passes
};

/// Reads both; the picture is that of the report's name with .exr. Throws InputError where one of them is missing or
/// damaged, where the report is of no render or of a version of vpm with other sections or settings, and where the
/// picture is of another render.
RenderReport read_report(const std::filesystem::path& path);

}  // namespace vpm::tools
