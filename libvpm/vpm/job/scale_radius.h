// The radius in media, chosen by how many photons lie within it, made wider where that leaves less error.
#pragma once

#include <vector>

#include "vpm/job/choice.h"
#include "vpm/render/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Multiplies `volume.radius`, if it was chosen, by the factor from 1 to 2.8 with which passes in the time of the
/// render, or as many as are asked for, are told to leave the least error: wider kernels have less noise and more bias,
/// and take longer. Bias of surfaces counts as if it were that of media, which keeps the radius smaller. Radii on
/// surfaces stay: at edges of shadows and caustics, and in corners, a pilot sees too little of the bias. The pilot
/// takes about four times `limit` s. Puts the radius into the settings and the choices.
void scale_radius(const Scene& scene, double limit, RenderSettings& settings, std::vector<Choice>& choices);

}  // namespace vpm
