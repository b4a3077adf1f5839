// Light that integrators do not find, or find by kernels alone: what lights without extent send by way of mirrors or
// glass.
#pragma once

#include <string>
#include <vector>

#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// The lights that no ray hits, as they have no extent or send light in one direction: of Scene::lights.
std::vector<size_t> unhittable_lights(const Scene& scene);

/// Are there mirrors or glass?
bool has_specular_surfaces(const Scene& scene);

/// "light 'lamp'", "lights 'lamp', number 3"; `names`: of the lights, "" where one has none.
std::string text_of_lights(const std::vector<size_t>& lights, const std::vector<std::string>& names);

/// What paths do not find, in a sentence: what such lights send by way of mirrors or glass onto what scatters it. No
/// shadow ray goes that way, and no path ends at such a light. "" where other integrators or other scenes are rendered.
std::string text_of_lost_light(const Scene& scene, const RenderSettings& settings,
                               const std::vector<std::string>& names);

/// What techniques combined may find by kernels alone, in a sentence: such light where mirrors or glass stand at every
/// second place of its path, so that no two vertices in a row can be connected. "" where there is none.
std::string text_of_kernel_light(const Scene& scene, const RenderSettings& settings,
                                 const std::vector<std::string>& names);

}  // namespace vpm
