// One render from a job to its files.
#include "picture_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

#include "error_log.h"
#include "option_checks.h"
#include "run_watch.h"
#include "this_process.h"
#include "vpm/base/atomic_file.h"
#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/base/file_lock.h"
#include "vpm/input/scene_file.h"
#include "vpm/job/checkpoint.h"
#include "vpm/job/messages.h"
#include "vpm/job/picture.h"
#include "vpm/job/report.h"
#include "vpm/ranks/messages.h"
#include "vpm/ranks/together.h"

namespace vpm::tools {
namespace {

/// The settings that ask for such layers.
void add_layers(std::vector<std::string> layers, std::vector<std::string>& overrides) {
  if (std::erase(layers, kCombinedLayers) > 0) overrides.push_back("integrator.layers=true");
  if (!layers.empty()) overrides.push_back(fmt::format("render.layers=[\"{}\"]", fmt::join(layers, "\", \"")));
}

/// Gives values to the settings that are "auto"; those of the checkpoint where the render goes on.
void choose_all(const RenderOptions& options, const Outputs& outputs, RenderJob& job) {
  if (options.resume && job.automatic.any())
    choose_again(job, choices_of(checkpoint_identity(outputs.checkpoint)));
  else
    choose(job, *clock_of_process());
}

std::optional<ErrorLog> make_error_log(const RenderOptions& options, const Outputs& outputs, const Film& film,
                                       const Camera& camera) {
  if (options.reference.empty()) return std::nullopt;
  if (std::error_code none; std::filesystem::equivalent(options.reference, outputs.exr, none))
    throw InputError(
        fmt::format("cannot write '{}': it is the reference; name another output with -o", outputs.exr.string()));
  return ErrorLog(options.reference, outputs.errors, film, camera);
}

/// Prints what a user should know before the first pass.
void look_ahead(const RenderOptions& options, RenderJob& job, const RenderResult& begun) {
  if (begun.film.passes() == 0) {
    foresee(job, *clock_of_process());
  }
  if (options.quiet) return;
  print_notes(job);
  const StopRule& until = job.settings.until;
  const bool enough = until.counts_passes() ? begun.film.passes() >= until.passes
                                            : until.seconds > 0.0 && begun.seconds >= until.seconds;
  if (enough)
    fmt::print(stderr, "note: the checkpoint has {} already, of {:.3g} s, and none is added\n",
               passes_text(begun.film.passes()), begun.seconds);
}

/// Of several ranks, which may be gone, this ends them all.
RenderEnd interrupted(Ranks& ranks, const StopRule& until, int passes) {
  const int status = say_interrupted(until, passes);
  if (ranks.size() > 1) ranks.abort(status);
  return {status, passes};
}

/// From now on the settings ask for those passes alone.
void apply_pass_range(const std::string& text, StopRule& until) {
  if (text.empty()) return;
  const PassRange range = pass_range(text);
  until = {.passes = range.end - range.first, .first = range.first};
}

}  // namespace

std::vector<std::string> known_layers() {
  std::vector<std::string> names{kCombinedLayers};
  for (const ViewLayerInfo& info : kViewLayers) names.emplace_back(info.name);
  return names;
}

std::vector<std::string> overrides_of(const RenderOptions& options) {
  std::vector<std::string> overrides = components_first(options.overrides);
  add_layers(options.layers, overrides);
  if (const size_t x = options.size.find('x'); x != std::string::npos) {
    overrides.push_back("film.width=" + options.size.substr(0, x));
    overrides.push_back("film.height=" + options.size.substr(x + 1));
  }
  if (!options.crop.empty()) overrides.push_back(fmt::format("film.crop=[{}]", options.crop));
  if (options.samples) overrides.push_back(fmt::format("render.samples_per_pixel={}", *options.samples));
  return overrides;
}

void write_outputs(const Outputs& outputs, const std::optional<float>& exposure, const RenderJob& job,
                   const RenderResult& result) {
  write_picture(outputs.exr, job, result);
  const Image picture = result.film.mean();
  write_preview(outputs, exposure, picture, exposure ? picture : without_fire(job.scene, picture));
  write_text(outputs.json, render_report(job, outputs.exr.string(), result));
}

std::unique_ptr<FileLock> lock_checkpoint(const std::filesystem::path& checkpoint, bool replaced) {
  auto lock = std::make_unique<FileLock>(checkpoint.string() + ".lock");
  if (!replaced && std::filesystem::exists(checkpoint))
    throw InputError(
        fmt::format("'{}' is there already: --resume goes on from it, --overwrite begins anew", checkpoint.string()));
  return lock;
}

void print_summary(const Outputs& outputs, const RenderJob& job, const RenderResult& result) {
  const std::string error = error_text(job, result);
  fmt::print("{}: {} in {:.1f} s{}{}; preview {}, report {}\n", outputs.exr.string(), passes_text(result.film.passes()),
             result.seconds, error.empty() ? "" : "; ", error, outputs.png.string(), outputs.json.string());
}

void apply_run_options(const RenderOptions& options, RenderJob& job) {
  apply_options(options, job.settings);
  StopRule& until = job.settings.until;
  if (options.seconds) until.seconds = *options.seconds;
  if (options.error) until.error = *options.error;
  if (options.pass_range.empty()) return;
  for (const auto& [key, value] : {std::pair{"seconds", until.seconds}, std::pair{"error", until.error}})
    if (value > 0.0)
      job.notes.push_back(fmt::format(
          "'{}' of [render] does not count for a piece: it has the passes of --pass-range, and chooses by counts",
          key));
  until.seconds = until.error = 0.0;  // so that pieces choose alike
}

/// Refuses pieces beyond the passes that there are in all, where their number is given.
void check_range(const RenderOptions& options) {
  if (options.pass_range.empty() || !options.passes || pass_range(options.pass_range).end <= *options.passes) return;
  throw InputError(fmt::format("--pass-range {}: --passes says that there are {} in all, 0:{}", options.pass_range,
                               *options.passes, *options.passes));
}

RenderJob load_for_render(const RenderOptions& options, const GridLoader& load) {
  check_range(options);
  const bool by_time = options.seconds && options.pass_range.empty();
  const LeftOut left_out = !options.automatic ? LeftOut::defaults
                           : by_time          ? LeftOut::all_automatic
                                              : LeftOut::automatic;
  RenderJob job = load_scene(options.scene, overrides_of(options), left_out, load);
  apply_run_options(options, job);
  return job;
}

namespace {

/// All but what is said where there is no picture.
RenderEnd render_finished_picture(const RenderOptions& options, const Outputs& outputs, RenderJob& job, Ranks& ranks) {
  const bool checkpoint = options.checkpoint || options.resume;
  const Camera& camera = job.scene.camera;
  const PixelRect rendered = camera.rendered();
  const int copies = options.watch.preview ? 2 : 1;  // a picture, and while it is rewritten its successor
  check_outputs(outputs, static_cast<uint64_t>(rendered.width()) * rendered.height() * copies, checkpoint, job);
  const std::unique_ptr<FileLock> lock =
      checkpoint ? lock_checkpoint(outputs.checkpoint, options.resume || options.overwrite) : nullptr;
  choose_all(options, outputs, job);
  apply_pass_range(options.pass_range, job.settings.until);
  const Identity identity = identity_of(job);
  send_render(ranks, identity);
  RenderResult begun = options.resume ? read_checkpoint(outputs.checkpoint, identity) : nothing_rendered(camera);
  std::optional<ErrorLog> log = make_error_log(options, outputs, begun.film, camera);
  look_ahead(options, job, begun);
  const ProgressMode progress = options.quiet ? ProgressMode::never : options.progress;
  RunWatch watch(options.watch, progress, outputs.exr.string(), begun.film,
                 [&](const RenderResult& so_far) { write_outputs(outputs, options.exposure, job, so_far); });
  const auto finished = [&](const RenderResult& so_far) {
    if (checkpoint) write_checkpoint(outputs.checkpoint, identity, origin_of(job), so_far);
    if (log) log->add(so_far);
    watch.finished(so_far);
  };
  const auto note = [&](const std::string& text) {
    const char* const after_bar = progress_enabled(progress) ? "\n" : "";
    if (!options.quiet) fmt::print(stderr, "{}note: {}\n", after_bar, text);
  };
  const RunControl control{progress, finished, clock_of_process(), job.foreseen_pass, job.what_fits, note};
  const RenderResult result = lead_render(ranks, job.scene, job.settings, std::move(begun), control);
  if (result.film.passes() == 0) return interrupted(ranks, job.settings.until, 0);
  const bool stopped = is_cancelled();
  const CancelledWith nothing(nullptr);  // what is finished is written
  print_warnings(warnings_of(job, result));
  if (log) log->finish(result);
  watch.finish(result);
  write_outputs(outputs, options.exposure, job, result);
  if (!options.quiet) print_summary(outputs, job, result);
  const int passes = result.film.passes();
  return stopped ? interrupted(ranks, job.settings.until, passes) : RenderEnd{0, passes};
}

}  // namespace

RenderEnd render_picture(const RenderOptions& options, const Outputs& outputs, RenderJob job, Ranks& ranks) {
  try {
    return render_finished_picture(options, outputs, job, ranks);
  } catch (const Cancelled&) {
    return interrupted(ranks, job.settings.until, 0);
  }
}

}  // namespace vpm::tools
