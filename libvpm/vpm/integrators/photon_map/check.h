// Rules that several components of photon maps share.
#pragma once

#include <string>

#include "vpm/base/settings/setting_error.h"
#include "vpm/integrators/settings.h"

namespace vpm {

/// Throws SettingError for a setting that contradicts blocks of photons, where there are any, because `why`: each is
/// gathered as if it were all, so that sums over photons add up, and nothing else does.
void refuse_in_blocks(const RenderSettings& settings, bool contradiction, const char* key, const std::string& why,
                      const std::string& right);
/// Likewise for a gather by the count of photons.
void refuse_count_in_blocks(const RenderSettings& settings, const AskedGather& gather, const char* key,
                            const char* right);
/// Likewise for a correction at borders where photons are merged, across borders too.
void refuse_correction_in_cubes(const RenderSettings& settings, const AskedGather& gather, const char* key);

}  // namespace vpm
