// Importons: particles from the camera that tell what light is worth to the picture, and where it should fly.
#pragma once

#include <optional>

#include "vpm/medium/distance/strategy.h"
#include "vpm/photon/direction_guide.h"
#include "vpm/photon/guide_settings.h"
#include "vpm/photon/importance_map.h"
#include "vpm/scene/scene.h"

namespace vpm {

struct Importance {
  ImportanceMap map;
  std::optional<DirectionGuide> directions;  // where GuideSettings::scatter asks for them
};

/// Importons from the camera [Peter1998, sec. 3]: eye paths, one from a random pixel each, that fly, scatter and are
/// absorbed as light would be, with radiance's factors. Each adds its tracks. `settings.importons` >= 1; a pure
/// function of settings, seed and pass.
Importance trace_importons(const Scene& scene, const DistanceStrategy& strategy, const GuideSettings& settings,
                           uint64_t seed, uint64_t pass, int max_events);

}  // namespace vpm
