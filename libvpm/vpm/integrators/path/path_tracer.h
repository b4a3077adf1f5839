// The reference path tracer: unbiased and volumetric. It uses the random walk and the direct light that photons use.
//
// Where it and the photon renderer disagree, the fault is in photon/ or estimate/.
#pragma once

#include <memory>

#include "vpm/film/image_pass.h"
#include "vpm/integrators/settings.h"
#include "vpm/medium/distance/strategy.h"
#include "vpm/medium/transmittance/estimator.h"

namespace vpm {

/// What a path tracer reads. Immutable while rays run.
struct PathContext {
  const Scene& scene;
  int max_events = 100'000;  // of one path, a guard against endless ones; paths that it cuts are counted
  std::unique_ptr<DistanceStrategy> distance;
  std::unique_ptr<TransmittanceEstimator> transmittance;
};
/// With the distance strategy, as it is in that pass, and the transmittance estimator that the settings name.
PathContext make_path_context(const Scene& scene, const RenderSettings& settings, int pass = 0);

/// One sample of the radiance along a ray that starts in `medium`, W/(m^2 sr). Each collision and each non-specular
/// surface adds the light of one emitter by a shadow ray. Emitters that the path itself hits count, too. The MIS
/// weights of the two are those of the balance heuristic [Veach1997, sec. 9.2]. Unbiased where the distance strategy
/// and the transmittance estimator are; nothing is clamped. Not finite where the path's throughput is not.
Rgb path_radiance(const PathContext& context, const Ray& ray, MediumId medium, Rng& rng, EyeCounters& counters);

/// Renders pass number `pass`, from 0.
Pass render_path_pass(const Scene& scene, const RenderSettings& settings, int pass, const PassProgress& progress = {});

}  // namespace vpm
