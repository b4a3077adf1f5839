// One pass of photon mapping: a pure function of the scene, the settings and the pass number. Where pixels have radii
// of their own, it also depends on these.
#pragma once

#include <optional>

#include "vpm/film/image_pass.h"
#include "vpm/integrators/photon_map/lamp_images.h"
#include "vpm/integrators/photon_map/photon_blocks.h"
#include "vpm/integrators/photon_map/plan.h"

namespace vpm {

/// What runs a pass besides scene and settings.
struct PassRun {
  int pass = 0;  // from 0
  PassProgress progress = {};
  std::optional<PhotonBlock> block = {};    // the photons of the pass that are traced; nothing: all of them
  const LampImages* lamp_images = nullptr;  // see EyeContext
};

/// Traces the photons of the pass into the recorders of the estimators, if there are any. They start with random
/// numbers, whatever PhotonSettings::sequence says, where a guide emits them, where the nearest are gathered,
/// and where they find places for irradiance.
void trace_pass(const Scene& scene, const RenderSettings& settings, const Estimators& estimators, const PassRun& run,
                RenderStatistics& statistics);
/// The same with recorders of someone else, which change none of the photons.
void trace_pass(const Scene& scene, const RenderSettings& settings, const Estimators& estimators, const PassRun& run,
                RenderStatistics& statistics, const Recorders& more);
/// Does the same, and then builds the estimators.
void prepare_pass(const Scene& scene, const RenderSettings& settings, const Estimators& estimators, const PassRun& run,
                  RenderStatistics& statistics);

/// How often the photons of a pass are traced: twice where rays march among those of several blocks, as these must know
/// beforehand where all of them lie.
int tracings_of_pass(const Scene& scene, const RenderSettings& settings);

/// Renders pass number `pass`, from 0, by blocks of photons where the settings say so (mean_of_blocks()).
Pass render_photon_pass(const Scene& scene, const RenderSettings& settings, int pass,
                        const PassProgress& progress = {});
/// The same where pixels have radii of their own, after passes that have left `discs`. Without discs, there was no
/// earlier pass.
Pass render_photon_pass_after(const PixelDiscs& discs, const Scene& scene, const RenderSettings& settings,
                              const PassRun& run);

}  // namespace vpm
