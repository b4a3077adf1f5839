// Passes of a pilot: all of a pass's photons, of which rays of some blocks of pixels all over the picture are followed.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/base/clock.h"
#include "vpm/integrators/settings.h"
#include "vpm/photon/kernel.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// A block is a square of 8 x 8 pixels, whose rays are followed together as those of a picture are; 5 x 5 of them lie
/// evenly in what is rendered of the picture. In small pictures some share pixels.
inline constexpr size_t kBlocksOfEdge = 5, kBlocks = kBlocksOfEdge * kBlocksOfEdge, kBlockRays = 64;
inline constexpr size_t kSmallRays = kBlocks * kBlockRays;

struct SmallPass {
  double photons = 0.0;          // that were emitted
  double making = 0.0;           // s: what tracing and sorting these took
  double aiming = 0.0;           // s: what each took that is aimed for caustics
  double seeing = 0.0;           // s: what rays through all pixels would take, by those that were followed
  double taken = 0.0;            // s, in all
  double followed = 1.0;         // rays, of those through all pixels
  double bytes = 0.0;            // of the photons
  uint64_t photon_steps = 0;     // rays and look-ups of the photons
  double eye_steps = 0.0;        // the same of rays through all pixels
  double gathered_by_ray = 0.0;  // photons
  /// As many photons as fill maps of 1.3 GB.
  double most_photons() const;
  // W/(m^2 sr), with its correction: the mean of a pixel's samples, block after block; black where not finite.
  std::vector<KernelEstimate> found{};
};

/// Makes pass number `pass` of the settings ready, and follows rays of blocks. Times are those of the clock.
SmallPass render_small(const Scene& scene, const RenderSettings& settings, int pass, const Clock& clock);

}  // namespace vpm
