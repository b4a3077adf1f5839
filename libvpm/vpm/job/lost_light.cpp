// Lost light follows from what the scene has: nothing is traced.
#include "vpm/job/lost_light.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/light/emission_density.h"
#include "vpm/scene/scene_facts.h"

namespace vpm {

std::vector<size_t> unhittable_lights(const Scene& scene) {
  std::vector<size_t> numbers;
  for (size_t i = 0; i < scene.lights.size(); ++i)
    if (!can_be_hit(scene.lights[i])) numbers.push_back(i);
  return numbers;
}

bool has_specular_surfaces(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) {
    return !is_rough(material) && !is_boundary(material) && !is_diffuse(material);
  });
}

std::string text_of_lights(const std::vector<size_t>& lights, const std::vector<std::string>& names) {
  std::vector<std::string> texts;
  for (const size_t i : lights)
    texts.push_back(i < names.size() && !names[i].empty() ? "'" + names[i] + "'" : fmt::format("number {}", i));
  return fmt::format("light{} {}", lights.size() > 1 ? "s" : "", fmt::join(texts, ", "));
}

std::string text_of_lost_light(const Scene& scene, const RenderSettings& settings,
                               const std::vector<std::string>& names) {
  const std::vector<size_t> lights = unhittable_lights(scene);
  const SceneFacts facts = facts_of(scene);
  if (settings.integrator != Integrator::path || lights.empty() || !has_specular_surfaces(scene) ||
      !(facts.scattering_media || facts.rough_surfaces))
    return "";
  return fmt::format(
      "paths do not find what {} may send by way of mirrors or glass, as no ray hits what has no extent: where there "
      "is such light, the picture lacks it; another integrator finds it, and paths do once the light has an extent",
      text_of_lights(lights, names));
}

std::string text_of_kernel_light(const Scene& scene, const RenderSettings& settings,
                                 const std::vector<std::string>& names) {
  const std::vector<size_t> lights = unhittable_lights(scene);
  const TechniqueSet& techniques = settings.combined.techniques;
  if (settings.integrator != Integrator::combined || !techniques.has(Technique::connections) || !merges(techniques) ||
      lights.empty() || !has_specular_surfaces(scene))
    return "";
  return fmt::format(
      "what {} may send by way of mirrors or glass to what is seen over others is found by kernels alone, and has "
      "their bias with nothing to check it by: no ray hits what has no extent",
      text_of_lights(lights, names));
}

}  // namespace vpm
