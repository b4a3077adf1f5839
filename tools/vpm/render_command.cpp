// vpm render: scene file in, picture and report out.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "commands.h"
#include "error_log.h"
#include "pass_run.h"
#include "report.h"
#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/base/version.h"
#include "vpm/image/exr.h"
#include "vpm/image/png.h"
#include "vpm/input/checkpoint.h"
#include "vpm/input/scene_file.h"
#include "vpm/render/plan.h"
#include "vpm/render/render.h"
#include "vpm/render/setting.h"

namespace vpm::tools {
namespace {

void apply_limits(const RenderOptions& options, RenderSettings& settings) {
  if (options.seconds) settings.seconds = *options.seconds;
  if (options.error) settings.error = *options.error;
}

void write_outputs(const Outputs& outputs, const RenderOptions& options, const LoadedScene& loaded,
                   const RenderResult& result) {
  const Image mean = result.film.mean();
  Metadata metadata = provenance(options, loaded, result.film);
  metadata.emplace_back(
      "vpm.quantity",
      "radiance, W/(m^2 sr); variance.*: variance of the mean of passes; bias.*: its kernels' bias as "
      "the passes show it");
  if (result.film.shows_bias()) {
    write_exr(outputs.exr, mean, {{"variance", result.errors->variance}, {"bias", result.errors->bias}}, metadata);
  } else if (result.film.passes() > 1) {
    write_exr(outputs.exr, mean, {{"variance", result.errors->variance}}, metadata);
  } else {
    write_exr(outputs.exr, mean, {}, metadata);
  }
  write_png(outputs.png, mean, auto_exposure(mean));
  write_text(outputs.json, render_report(options.scene, outputs.exr.string(), loaded, result));
}

constexpr const char* kChosen = "chosen";  // the field that names the settings that were chosen

/// What a checkpoint must agree in for its passes to be those of this render: fields, and which of the settings among
/// them were chosen.
std::string identity_of(const LoadedScene& loaded, const std::vector<Choice>& choices) {
  std::string identity = fmt::format("vpm {}: scene={} render.seed={} {}", version(), loaded.hash, loaded.settings.seed,
                                     settings_line(loaded.settings));
  std::vector<std::string> keys;
  for (const Choice& choice : choices) keys.push_back(choice.key);
  if (loaded.automatic.any()) identity += fmt::format(" {}={}", kChosen, fmt::join(keys, ","));
  return identity;
}

/// The settings that were chosen when the checkpoint's render began.
std::vector<Choice> choices_of(const std::filesystem::path& checkpoint) {
  const std::string identity = checkpoint_identity(checkpoint);
  std::vector<Choice> choices;
  std::istringstream keys(field_of(identity, kChosen).value_or(""));
  for (std::string key; std::getline(keys, key, ',');)
    choices.push_back({key, field_of(identity, key).value_or(""), "as chosen when the render began"});
  return choices;
}

/// Gives values to the settings that are "auto", and says so in the scene's notes.
std::vector<Choice> choose(const RenderOptions& options, const Outputs& outputs, LoadedScene& loaded) {
  if (!loaded.automatic.any()) return {};
  std::vector<Choice> choices;
  if (options.resume) {
    choices = choices_of(outputs.checkpoint);
    for (const Choice& choice : choices) set_chosen(loaded.settings, choice.key, choice.value);
  } else {
    const auto start = std::chrono::steady_clock::now();
    choices = choose_settings(loaded.scene, loaded.automatic, loaded.settings);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    loaded.notes.push_back(fmt::format("choosing settings took {:.2g} s", seconds.count()));
  }
  std::string again;
  for (const Choice& choice : choices) {
    loaded.notes.push_back(fmt::format("chosen {} = {}: {}", choice.key, choice.value, choice.reason));
    again += fmt::format(" --set {}={}", choice.key, choice.value);
  }
  loaded.notes.push_back("the same picture again without choosing:" + again);
  return choices;
}

/// The error that the passes are estimated to have, as far as they tell.
std::string error_text(const LoadedScene& loaded, const RenderResult& result) {
  if (result.film.passes() < kLeastPasses) return "";
  const FilmErrors& errors = *result.errors;
  const std::vector<std::string> unseen = maps_of_unseen_bias(loaded.scene, loaded.settings);
  return fmt::format(
      "; estimated relative MSE {:.2g} (variance {:.2g}, {}{})", estimated_error(result), errors.variance_part,
      result.film.shows_bias() ? fmt::format("squared bias {:.2g}", errors.bias_part) : "no bias to be seen",
      unseen.empty()
          ? ""
          : fmt::format("; not seen: that of [{}], whose radii are not those of passes", fmt::join(unseen, "], [")));
}

std::optional<ErrorLog> make_error_log(const RenderOptions& options, const Outputs& outputs, const Film& film) {
  if (options.reference.empty()) return std::nullopt;
  if (std::error_code none; std::filesystem::equivalent(options.reference, outputs.exr, none))
    throw InputError(
        fmt::format("cannot write '{}': it is the reference; name another output with -o", outputs.exr.string()));
  return ErrorLog(options.reference, outputs.errors, film);
}

}  // namespace

int render_command(const RenderOptions& options) {
  set_threads(options.threads);
  const Outputs outputs = output_paths(options, std::filesystem::path(options.scene).stem().string());
  LoadedScene loaded =
      load_scene(options.scene, options.overrides, options.automatic ? LeftOut::automatic : LeftOut::usual);
  apply_options(options, loaded.settings);
  apply_limits(options, loaded.settings);
  const bool checkpoint = options.checkpoint || options.resume;
  const Camera& camera = loaded.scene.camera;
  check_outputs(outputs, static_cast<uint64_t>(camera.width) * camera.height, checkpoint, options, loaded);
  const std::vector<Choice> choices = choose(options, outputs, loaded);
  const std::string identity = identity_of(loaded, choices);
  RenderResult begun = options.resume ? read_checkpoint(outputs.checkpoint, identity) : nothing_rendered(camera);
  std::optional<ErrorLog> log = make_error_log(options, outputs, begun.film);
  print_notes(loaded);
  const std::atomic<bool>& stop = stop_on_signals();
  const RenderResult result =
      render(loaded.scene, loaded.settings, std::move(begun), stop, options.progress, [&](const RenderResult& so_far) {
        if (checkpoint) write_checkpoint(outputs.checkpoint, identity, so_far);
        if (log) log->add(so_far);
      });
  print_warnings(scattering_of(loaded.scene), loaded.settings, result.statistics);
  if (result.film.passes() == 0) {
    fmt::print(stderr, "interrupted before the first pass was finished: nothing is written\n");
    return kInterrupted;
  }
  if (log) log->finish(result);
  write_outputs(outputs, options, loaded, result);
  fmt::print("{}: {} passes in {:.1f} s{}; preview {}, report {}\n", outputs.exr.string(), result.film.passes(),
             result.seconds, error_text(loaded, result), outputs.png.string(), outputs.json.string());
  return stop ? kInterrupted : 0;
}

}  // namespace vpm::tools
