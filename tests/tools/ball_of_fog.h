// A scene that renders in no time.
#pragma once

#include <fmt/format.h>
#include <string>

namespace vpm {

/// A ball of fog in parallel light, on a film of that size.
inline std::string ball_of_fog(int width, int height) {
  return fmt::format(R"([camera]
position = [0, 0, 3]
target = [0, 0, 0]
[film]
width = {}
height = {}
[media.fog]
type = "homogeneous"
sigma_s = 0.5
sigma_a = 0.1
[[shapes]]
type = "sphere"
material = {{ type = "boundary" }}
center = [0, 0, 0]
radius = 1
inside = "fog"
[[lights]]
type = "directional"
direction = [0, -1, 0.2]
irradiance = 3
[integrator.photons]
emitted = 2000
)",
                     width, height);
}

}  // namespace vpm
