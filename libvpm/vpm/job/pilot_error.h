// What error a pass leaves, told by a few small passes of a pilot.
#pragma once

#include "vpm/job/pilot.h"
#include "vpm/render/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Parts of the relative MSE of one pass.
struct PassError {
  double variance = 0.0;
  double bias2 = 0.0;  // what the kernels' corrections tell of the squared bias
};
/// Renders rays of blocks of pixels with photons of several seeds, in about so many seconds. Where the photons of these
/// passes would take longer, they are fewer, and their noise is taken to go with one over their number.
PassError error_of_pass(const Scene& scene, const RenderSettings& settings, const PassCost& cost, double seconds);

/// What is left of it after so many passes: shrinking radii let variance and squared bias fall alike, by best_a();
/// under constant ones bias is left.
double error_after(const PassError& error, const Scene& scene, const RenderSettings& settings, double passes);

}  // namespace vpm
