// A pass of any integrator for a pilot, which follows only some of its rays.
#pragma once

#include "vpm/film/image_pass.h"
#include "vpm/image/image.h"
#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// A pass with its photons or light sub-paths ready.
struct RaysOfPass {
  RadianceOfRays radiance;  // keeps what it reads
  Image light_tracing;      // what light sub-paths add to each pixel; empty where the integrator has none
  RenderStatistics statistics{};
};
/// Makes pass number `pass` ready, which the scene must outlive; of combined techniques with the shares of so many
/// light sub-paths, see CombinedPass.
RaysOfPass rays_of_pass(const Scene& scene, const RenderSettings& settings, int pass, uint64_t paths_of_shares = 0);

}  // namespace vpm
