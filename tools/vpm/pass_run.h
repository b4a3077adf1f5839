// What the subcommands that run passes have in common: the files they write, the options that overrule the scene, and
// what they print.
#pragma once

#include <filesystem>

#include "commands.h"
#include "this_process.h"
#include "vpm/image/image.h"
#include "vpm/job/photon_passes.h"
#include "vpm/job/render_job.h"

namespace vpm::tools {

/// An image, and the files that are written next to it.
struct Outputs {
  std::filesystem::path exr, png, json, checkpoint, errors;
};

/// The paths next to an image, which must end in .exr; where it is empty: `name`.exr in the current folder.
Outputs output_paths(const std::string& image, const std::string& name);

/// Throws InputError where an output, of an image of that many pixels, could not be written, or would replace a file
/// that the scene is read from.
void check_outputs(const Outputs& outputs, uint64_t pixels, bool checkpoint, const RenderJob& job);

/// Writes the PNG preview of a picture, exposed by so many stops or else by auto_exposure() of `exposed_by`.
void write_preview(const Outputs& outputs, const std::optional<float>& exposure, const Image& picture,
                   const Image& exposed_by);
/// The picture of a scene without the pixels that show, straight on, media which emit more than anything else, unless
/// hardly any others are lit: fire is often far brighter than what it lights, by which exposures go.
Image without_fire(const Scene& scene, Image picture);

/// The seed and the number of passes.
void apply_options(const PassOptions& options, RenderSettings& settings);

/// How photons are counted pass by pass.
PhotonRun photon_run(const CountOptions& options);

/// What a user should know before the run; on stderr, so that it is seen.
void print_notes(const RenderJob& job);
/// What went wrong without stopping the run; on stderr, too.
void print_warnings(const std::vector<std::string>& warnings);
/// After how many passes a run was interrupted; without any nothing is written. Returns the exit status.
int say_interrupted(const StopRule& until, int passes);

}  // namespace vpm::tools
