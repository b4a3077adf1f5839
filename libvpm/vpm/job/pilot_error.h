// What error a pass leaves, told by a few small passes of a pilot.
#pragma once

#include <array>
#include <vector>

#include "vpm/job/pass_cost.h"
#include "vpm/render/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Parts of the relative MSE of one pass.
struct PassError {
  double rays = 0.0;     // variance of what rays find among the same photons
  double photons = 0.0;  // variance that is due to photons
  double bias2 = 0.0;    // what the kernels' corrections surely tell of the squared bias: less a standard error
};

/// What a block of pixels, or all blocks together, show in one channel.
struct SeenMean {
  double mean = 0.0, standard_error = 0.0, correction = 0.0;  // W/(m^2 sr); of the kernels' bias
};

struct PilotError {
  PassError pass{};
  std::vector<SeenMean> seen{};      // channel by channel, of each block by block
  std::array<SeenMean, 3> in_all{};  // of all blocks, channel by channel
  double rays = 0.0;                 // of each block, in all small passes
};
/// Renders rays of blocks of pixels with photons or light sub-paths of several seeds, in about so many seconds. Where
/// those of a pass would take longer, they are fewer, and their noise is taken to go with one over their number: it
/// goes faster where photons start at points of a sequence (PhotonSequence), and is then told too large.
PilotError error_of_pass(const Scene& scene, const RenderSettings& settings, const PassCost& cost, double seconds);

/// The relative MSE of one ray that is due to light which its rays have not met, but others show: more than four
/// standard errors of either above what it shows, in a block, or in all together where light is missing that no
/// block is sure of. A ray that meets such light is taken to be rarer than one in all that the block or all blocks
/// have, and so its square is at least their number times that of the mean.
double unseen_light(const PilotError& error, const PilotError& other);

/// What is left of it after so many passes, >= 1. The noise of rays falls as one over them. That of photons and the
/// bias go as radii do: all are taken to shrink as those of discs, whatever is gathered, as noise on surfaces is not
/// told from that in media.
double error_after(const PassError& error, const RenderSettings& settings, int passes);

}  // namespace vpm
