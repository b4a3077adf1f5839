// Light maps baked in many passes.
#pragma once

#include "vpm/job/render.h"
#include "vpm/render/light_map.h"

namespace vpm {

/// Passes of a light map until the settings' stop rule is met, as render(). The picture is not dilated(). Throws a
/// SettingError where validate_light_map() does.
RenderResult bake_light_map(const Scene& scene, const RenderSettings& settings, const UvLayout& layout,
                            const RunControl& control);

}  // namespace vpm
