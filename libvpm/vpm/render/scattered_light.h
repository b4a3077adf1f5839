// Light that a point of a medium receives and scatters towards the eye.
#pragma once

#include <optional>

#include "vpm/path/direct_light.h"
#include "vpm/render/eye_context.h"

namespace vpm {

/// A light, and a point of it where one is drawn beforehand.
struct LightSource {
  PickedLight picked;
  std::optional<LightPoint> from;
};
/// What a light sends to a point of a medium, scattered there against `travel`, the direction of the ray that sees it:
/// irradiance times phase function over the probability to pick that light, W/(m^2 sr).
Rgb scattered_light(const EyeContext& context, const LightSource& light, const Receiver& point, const Vec3& travel,
                    Rng& rng, EyeCounters& counters);

}  // namespace vpm
