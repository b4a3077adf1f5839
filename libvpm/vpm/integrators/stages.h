// What the lines of several integrators say of their stages.
#pragma once

#include <string>

#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// ", distances by regular (exact in any medium: ...)".
std::string distances_text(const RenderSettings& settings);
/// ", transmittance by ray-march (biased; ...)".
std::string transmittance_text(const RenderSettings& settings);
std::string channels_text(const Scene& scene);

}  // namespace vpm
