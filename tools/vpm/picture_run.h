// What vpm render, vpm view and vpm merge have in common: a job becomes a picture, a preview and a report.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "pass_run.h"
#include "vpm/base/file_lock.h"
#include "vpm/input/grid/grid_file.h"
#include "vpm/job/render_job.h"
#include "vpm/ranks/ranks.h"
#include "vpm/render/render.h"

namespace vpm::tools {

/// The options that change keys of a scene file, as --set options.
std::vector<std::string> overrides_of(const RenderOptions& options);

/// Writes the picture, its preview, exposed by so many stops or else by auto_exposure(), and the report.
void write_outputs(const Outputs& outputs, const std::optional<float>& exposure, const RenderJob& job,
                   const RenderResult& result);

/// The lock on a checkpoint. Throws InputError where another run keeps it, and where a checkpoint is there that is not
/// to be replaced.
std::unique_ptr<FileLock> lock_checkpoint(const std::filesystem::path& checkpoint, bool replaced);

/// A line of what is rendered, and where it is.
void print_summary(const Outputs& outputs, const RenderJob& job, const RenderResult& result);

/// The seed, and when the render ends; the job notes what of the scene does not decide that.
void apply_run_options(const RenderOptions& options, RenderJob& job);

/// The job of a scene file with these options; its grids are loaded by `load`, as load_scene() does.
RenderJob load_for_render(const RenderOptions& options, const GridLoader& load = {});

/// How a render ended: where there is no pass, it has written nothing.
struct RenderEnd {
  int status;  // of the process
  int passes;
};
/// Renders a job as the options say, which have changed its scene already, with the other ranks. Throws NoPassFits.
RenderEnd render_picture(const RenderOptions& options, const Outputs& outputs, RenderJob job, Ranks& ranks);

}  // namespace vpm::tools
