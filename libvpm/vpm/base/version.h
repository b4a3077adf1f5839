// Which vpm this is, for `vpm --version` and for the provenance of every image.
#pragma once

#include <string_view>

namespace vpm {

/// "0.1.0 (1a2b3c4d5e6f)": the release, and the git commit it was built from where known, "-modified" where files
/// differ from it; ", without counters" where it was built with VPM_COUNTERS=OFF.
std::string_view version();

}  // namespace vpm
