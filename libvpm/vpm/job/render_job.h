// A job: a scene, how it is to be rendered, and where it is from, for reports and pictures. Scene files become
// one, and so do parts put together in code; every front end runs it by the same few calls:
//
//   RenderJob job = load_scene("fog.toml");                    // or make_job(assemble(parts))
//   choose(job);                                               // what is "auto", and radii that are left out
//   const RenderResult result = render(job.scene, job.settings, nothing_rendered(job.scene.camera));
//   write_picture("fog.exr", job, result);
//   write_text("fog.json", render_report(job, "fog.exr", result));
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "vpm/base/clock.h"
#include "vpm/integrators/choice.h"
#include "vpm/integrators/settings.h"
#include "vpm/scene/assemble.h"

namespace vpm {

struct RenderJob {
  Scene scene;  // finished
  RenderSettings settings;
  AutomaticSettings automatic;           // those of the settings that choose() is to choose
  std::vector<Choice> choices{};         // what it chose
  std::vector<std::string> light_names;  // one for each of Scene::lights; "" where it has none
  std::vector<std::string> notes;        // what a user should know of, e.g. clamped densities
  std::string replaced{};                // of these: which options left out what of the file; ""
  std::string source{};                  // the scene file; empty: made in code
  std::vector<std::string> overrides{};  // "key.path=value" options that changed that file
  bool chooses_defaults = false;         // was what the file leaves out to be chosen, where that is possible?
  std::vector<std::string> files{};      // that it names: grids, meshes, textures, environments
  std::string hash{};                    // other scenes and settings of files have another: of the scene
                                         // file with its options, and of the bytes of those files, 16 hex digits; of
                                         // scenes made in code what their maker says
  std::vector<std::pair<std::string, std::string>> contents{};  // of the scene file, with its options: what is no
                                                                // setting, by name; and hashes of those files
  double foreseen_pass = 0.0;                                   // s that a pass takes, once foresee() has estimated it
  std::string what_fits{};  // would make a pass fit into the time asked for, where none is foreseen to; or ""
  uint64_t clamped_density_values = 0;  // negative densities set to 0 on the scene's request, over all grids
};

/// The job of a scene made in code. Radii that the settings do not give are left to choose(); without that they are 1 %
/// of the scene's diagonal.
RenderJob make_job(AssembledScene assembled, const RenderSettings& settings = {});

/// Chooses the settings that are left to it, after a short pilot, and says so in the job's notes; where nothing is
/// "auto", the radii alone that nothing is said of, without a note. Does nothing where there are none. Where a time is
/// asked for, the render has what is left of it on the clock, and what takes more than its part of that is given up.
/// Throws InputError as choose_settings(), and NoPassFits where twice the time is over before the radii are known.
void choose(RenderJob& job, const Clock& clock = WallClock());
/// The same where nothing is "auto", however long that takes; else nothing.
void choose_default_radii(RenderJob& job);
/// The same with the choices of an earlier run, in the place of a pilot, but for radii that are given now. Throws
/// InputError as set_chosen().
void choose_again(RenderJob& job, std::vector<Choice> choices);

/// Throws InputError where a setting is "auto", for a command that chooses none.
void refuse_automatic(const RenderJob& job, const std::string& command);

/// Throws InputError where writing to `path` would replace a file that the scene is read from.
void check_not_read(const std::filesystem::path& path, const RenderJob& job);

/// Looks ahead at the first pass. Notes in the job where a ray gathers very many photons, and where it will not fit
/// into what is left on the clock of the seconds of the stop rule, and what would; or that a look is not enough to say.
/// Of four looks at a few photons and rays each may take a tenth of these seconds, and at most a second. Throws
/// InputError where the photons of a pass will not fit into the memory of the machine.
void foresee(RenderJob& job, const Clock& clock = WallClock());
/// The same of a light map's memory alone: how long its passes take is not estimated.
void foresee_light_map(const RenderJob& job);

}  // namespace vpm
