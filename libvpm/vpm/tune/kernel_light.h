// Light that no technique without a kernel finds, as that of point lights seen through glass on what glass lights.
#pragma once

#include <optional>
#include <vector>

#include "vpm/film/film.h"
#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Light that techniques combined find by kernels alone: it has their bias, and nothing without bias to check it by.
struct KernelLight {
  Estimated share;             // of all light that the picture shows, a mean over channels
  std::vector<size_t> lights;  // that may send it, as no ray hits them: of Scene::lights
  bool traced = true;          // is light tracing among the techniques?
};

/// Measures that light by a few light sub-paths and rays through 64 blocks of pixels; the standard error is that of the
/// light in these. The same on any machine. Nothing where none is seen, and where techniques are not combined, or
/// connections are not among them.
std::optional<KernelLight> kernel_light_of(const Scene& scene, const RenderSettings& settings);

/// "0.023 +- 0.001 of the light is found by kernels alone: ..."; `names`: of the lights, "" where one has none.
std::string text_of(const KernelLight& found, const std::vector<std::string>& names);

}  // namespace vpm
