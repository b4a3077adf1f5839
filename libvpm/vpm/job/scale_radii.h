// Radii that were chosen by how many photons lie within them, made wider or narrower by what error they leave.
#pragma once

#include <vector>

#include "vpm/job/choice.h"
#include "vpm/render/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Multiplies all radii that were chosen by one factor, as long as a pilot tells that passes in the time of the render,
/// or as many as are asked for, leave a smaller error then: wider kernels have less noise and more bias, and take
/// longer. Each try takes about twice `limit` s. Puts them into the settings and the choices.
void scale_radii(const Scene& scene, double limit, RenderSettings& settings, std::vector<Choice>& choices);

}  // namespace vpm
