// Renders of scenes, by any integrator.
#pragma once

#include <string>
#include <vector>

#include "vpm/base/settings/setting_error.h"
#include "vpm/integrators/settings.h"
#include "vpm/render/render.h"
#include "vpm/scene/scene_facts.h"

namespace vpm {

/// Throws a SettingError where a setting of the chosen components is out of its range, or contradicts another or the
/// scene. Members that these components do not have are not looked at, here as in a render.
void validate(const RenderSettings& settings, const SceneFacts& facts);
/// The same for a light map, which is of photon maps, has no radii of pixels' own, and is not baked until an error is
/// reached.
void validate_light_map(const RenderSettings& settings, const SceneFacts& facts);

/// Renders passes until the settings' stop rule is met, or the work is given up (base/cancel.h): see run_passes().
/// `result` is nothing_rendered() or what an earlier run has left off with, for the same scene and settings: passes go
/// on where it ended.
///
/// Throws a SettingError where settings contradict themselves or the scene, InputError where the result is of another
/// size than the camera's film, and NoPassFits.
RenderResult render(const Scene& scene, const RenderSettings& settings, RenderResult result,
                    const RunControl& control = {});
/// The passes of render(): of the scene and the settings, which must live longer than what is returned.
PassMaker pass_maker(const Scene& scene, const RenderSettings& settings);
/// Throws what render() throws before its first pass.
void check_begun(const Scene& scene, const RenderSettings& settings, const RenderResult& result);

/// Does such a render gather by kernels, so that it may be biased?
bool gathers(const Scene& scene, const RenderSettings& settings);

/// Which stages of a render run, how, and which do not and why: a line for each. `shown` is what the picture shows of
/// the scene.
std::vector<std::string> stage_lines(const Scene& scene, const RenderSettings& settings, const SceneFacts& shown);

/// What of a render's counts its integrator warns of, a sentence each.
std::vector<std::string> integrator_warnings(const SceneFacts& shown, const RenderSettings& settings,
                                             const RenderStatistics& statistics);

/// The names of the layers that passes under these settings have of what techniques find: "combined.NAME.weighted",
/// whose sum over techniques is the picture, and "combined.NAME.unweighted", for each technique. None where they are
/// not asked for.
std::vector<std::string> layer_names(const RenderSettings& settings);
/// How many films a render under these settings has besides its picture: those of layer_names(), then view_films().
size_t layer_films(const RenderSettings& settings);
/// How many channels all its layers fill, variances included.
size_t layer_channels(const RenderSettings& settings);

}  // namespace vpm
