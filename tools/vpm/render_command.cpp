// vpm render: scene file in, picture and report out.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cstdio>
#include <filesystem>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parallel.h"
#include "base/version.h"
#include "commands.h"
#include "image/exr.h"
#include "image/png.h"
#include "input/checkpoint.h"
#include "input/scene_file.h"
#include "pass_run.h"
#include "render/photon_pass.h"
#include "render/render.h"
#include "report.h"

namespace vpm::tools {
namespace {

struct Outputs {
  std::filesystem::path exr, png, json, checkpoint;
};

Outputs output_paths(const RenderOptions& options) {
  const std::filesystem::path exr = exr_path(options.output, options.scene);
  const auto beside = [&](const char* extension) { return std::filesystem::path(exr).replace_extension(extension); };
  return {exr, beside(".png"), beside(".json"), beside(".checkpoint")};
}

void check_outputs(const Outputs& outputs, const Camera& camera, bool checkpoint) {
  constexpr uint64_t kReportBytes = 1 << 16;
  const uint64_t pixels = static_cast<uint64_t>(camera.width) * camera.height;
  const uint64_t film = checkpoint ? 2 * pixels * 6 * sizeof(Rgbd) : 0;           // the checkpoint, and its successor
  const uint64_t bytes = pixels * (9 * sizeof(float) + 3) + film + kReportBytes;  // of all, which share a folder
  check_writable(outputs.exr, bytes);
  check_writable(outputs.png, bytes);
  check_writable(outputs.json, bytes);
  if (checkpoint) check_writable(outputs.checkpoint, bytes);
}

void apply_options(const RenderOptions& options, RenderSettings& settings) {
  if (options.seed) settings.seed = *options.seed;
  if (options.passes) {
    settings.passes = *options.passes;
    settings.seconds = settings.error = 0.0;
  }
  if (options.seconds) settings.seconds = *options.seconds;
  if (options.error) settings.error = *options.error;
}

void write_outputs(const Outputs& outputs, const RenderOptions& options, const LoadedScene& loaded,
                   const RenderResult& result) {
  const Image mean = result.film.mean();
  const std::vector<std::pair<std::string, std::string>> metadata{
      {"vpm.version", std::string(version())},
      {"vpm.scene", std::filesystem::path(options.scene).filename().string()},
      {"vpm.sceneHash", loaded.hash},
      {"vpm.overrides", fmt::format("{}", fmt::join(options.overrides, " "))},
      {"vpm.settings", settings_line(loaded.settings)},
      {"vpm.quantity",
       "radiance, W/(m^2 sr); variance.*: variance of the mean of passes; bias.*: its kernels' bias as the passes show "
       "it"},
      {"vpm.seed", std::to_string(loaded.settings.seed)},
      {"vpm.passes", std::to_string(result.film.passes())}};
  if (result.film.shows_bias()) {
    const FilmErrors errors = result.film.errors();
    write_exr(outputs.exr, mean, {{"variance", errors.variance}, {"bias", errors.bias}}, metadata);
  } else if (result.film.passes() > 1) {
    write_exr(outputs.exr, mean, {{"variance", result.film.variance_of_mean()}}, metadata);
  } else {
    write_exr(outputs.exr, mean, {}, metadata);
  }
  write_png(outputs.png, mean, auto_exposure(mean));
  write_text(outputs.json, render_report(options.scene, outputs.exr.string(), loaded, result));
}

/// What a checkpoint must agree in for its passes to be those of this render.
std::string identity_of(const LoadedScene& loaded) {
  return fmt::format("vpm {}; scene {}; seed {}; {}", version(), loaded.hash, loaded.settings.seed,
                     settings_line(loaded.settings));
}

/// The error that the passes are estimated to have, as far as they tell.
std::string error_text(const LoadedScene& loaded, const Film& film) {
  if (film.passes() < kLeastPasses) return "";
  const FilmErrors errors = film.errors();
  const std::vector<std::string> unseen =
      maps_of_one_radius(loaded.settings, plan_stages(loaded.scene, loaded.settings));
  return fmt::format(
      "; estimated relative MSE {:.2g} (variance {:.2g}, {}{})", estimated_error(film), errors.variance_part,
      film.shows_bias() ? fmt::format("squared bias {:.2g}", errors.bias_part) : "no bias to be seen",
      unseen.empty() ? ""
                     : fmt::format("; not seen: that of [{}], where radii do not shrink", fmt::join(unseen, "], [")));
}

}  // namespace

int render_command(const RenderOptions& options) {
  set_threads(options.threads);
  const Outputs outputs = output_paths(options);
  LoadedScene loaded = load_scene(options.scene, options.overrides);
  apply_options(options, loaded.settings);
  const bool checkpoint = options.checkpoint || options.resume;
  check_outputs(outputs, loaded.scene.camera, checkpoint);
  const std::string identity = identity_of(loaded);
  RenderResult begun =
      options.resume ? read_checkpoint(outputs.checkpoint, identity) : nothing_rendered(loaded.scene.camera);
  const std::atomic<bool>& stop = stop_on_signals();
  const RenderResult result =
      render(loaded.scene, loaded.settings, std::move(begun), stop, options.progress, [&](const RenderResult& so_far) {
        if (checkpoint) write_checkpoint(outputs.checkpoint, identity, so_far);
      });
  print_warnings(loaded, plan_stages(loaded.scene, loaded.settings), result.statistics);
  if (result.film.passes() == 0) {
    fmt::print(stderr, "interrupted before the first pass was finished: nothing is written\n");
    return kInterrupted;
  }
  write_outputs(outputs, options, loaded, result);
  fmt::print("{}: {} passes in {:.1f} s{}; preview {}, report {}\n", outputs.exr.string(), result.film.passes(),
             result.seconds, error_text(loaded, result.film), outputs.png.string(), outputs.json.string());
  return stop ? kInterrupted : 0;
}

}  // namespace vpm::tools
