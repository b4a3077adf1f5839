// Light maps baked in many passes.
#pragma once

#include "vpm/base/statistics/channel_moments.h"
#include "vpm/integrators/photon_map/surface/light_map.h"

#include "vpm/render/render.h"

namespace vpm {

struct LightMap {
  RenderResult render;
  ChannelMoments
      power;  // of passes: received_power(), W. Texels of a pass have photons in common: no error follows from them
};

/// Passes of a light map until the settings' stop rule is met, as render(). The picture is not dilated(). Throws a
/// SettingError where validate_light_map() does.
LightMap bake_light_map(const Scene& scene, const RenderSettings& settings, const UvLayout& layout,
                        const RunControl& control);

}  // namespace vpm
