// The error that a pass leaves, estimated from a few small passes of a pilot.
#pragma once

#include <cstddef>
#include <vector>

#include "vpm/base/vec.h"
#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"
#include "vpm/tune/pass_cost.h"

namespace vpm {

/// A picture's squared bias goes as the fourth power of the radius where light is smooth, and as the first or second at
/// edges: stated errors take a middle, too (papers/stated-error.md).
constexpr double kPowerOfBias = 2.5;

/// Parts of the relative MSE of one pass.
struct PassError {
  double rays = 0.0;     // variance of what rays find among the same photons
  double photons = 0.0;  // variance that is due to photons
  double bias2 = 0.0;    // the squared bias by the kernels' corrections
};

struct PilotError {
  PassError pass{};
  size_t pixels = 0;  // of each block: a power of two, every (kRaysOfBlock / pixels)-th of the same ones
  // Block by block, W/(m^2 sr). The places of pixels are the same for all ways to render.
  std::vector<std::vector<Rgb>> shown{};  // the light of each pixel, pass by pass
  std::vector<Rgb> corrections{};         // of kernels, in the mean of passes
};

/// Renders rays of blocks of pixels with photons or light sub-paths of several seeds, in about so many seconds. Where
/// those of a pass would take longer, they are fewer, and their noise is taken to go with one over their number: it
/// goes faster where photons start at points of a sequence (PhotonSequence), and is then estimated too large.
PilotError error_of_pass(const Scene& scene, const RenderSettings& settings, const PassCost& cost, double seconds);

/// The relative MSE of one ray that is due to light which its rays have not met, but others show in the same pixels:
/// more than four standard errors of either above what it shows, in a block, or in all together where light is missing
/// that no block is sure of. A ray that meets such light is taken to be rarer than one in all that went there, and so
/// its square is at least their number times that of the mean.
double unseen_light(const PilotError& error, const PilotError& other);

/// What is left of it after so many passes, >= 1. The noise of rays falls as one over them. That of photons and the
/// bias go as radii do: all are taken to shrink as those of discs, whatever is gathered, as noise on surfaces is not
/// estimated from that in media.
double error_after(const PassError& error, const RenderSettings& settings, int passes);

}  // namespace vpm
