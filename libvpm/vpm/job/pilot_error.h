// What error a pass leaves, told by a few small passes of a pilot.
#pragma once

#include "vpm/job/pilot.h"
#include "vpm/render/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Parts of the relative MSE of one pass.
struct PassError {
  double rays = 0.0;     // variance of what rays find among the same photons
  double photons = 0.0;  // variance that is due to photons
  double bias2 = 0.0;    // what the kernels' corrections tell of the squared bias
};
/// Renders rays of blocks of pixels with photons of several seeds, in about so many seconds. Where the photons of these
/// passes would take longer, they are fewer, and their noise is taken to go with one over their number.
PassError error_of_pass(const Scene& scene, const RenderSettings& settings, const PassCost& cost, double seconds);

/// What is left of it after so many passes, >= 1. The noise of rays falls as one over them. That of photons and the
/// bias go as radii do: all are taken to shrink as those of discs, whatever is gathered, as noise on surfaces is not
/// told from that in media.
double error_after(const PassError& error, const RenderSettings& settings, int passes);

}  // namespace vpm
