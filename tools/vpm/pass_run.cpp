// Signals, warnings, and paths that can be written without harm.
#include "pass_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <csignal>
#include <cstdio>

#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"
#include "vpm/base/version.h"
#include "vpm/render/setting.h"

namespace vpm::tools {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

const std::atomic<bool>& stop_on_signals() {
  const auto request = [](int number) {
    stop_requested = true;
    std::signal(number, SIG_DFL);
  };
  std::signal(SIGINT, request);
  std::signal(SIGTERM, request);
  return stop_requested;
}

void print_notes(const LoadedScene& loaded) {
  for (const std::string& note : loaded.notes) fmt::print(stderr, "note: {}\n", note);
}

void print_warnings(const Scattering& shown, const RenderSettings& settings, const RenderStatistics& s) {
  const auto warn = [](uint64_t count, const char* what) {
    if (count > 0) fmt::print(stderr, "warning: {} {}\n", count, what);
  };
  const bool photons = settings.integrator == Integrator::photon;
  if (photons && shown.media && s.volume_photons == 0)
    fmt::print(stderr, "warning: the volume photon map is empty: no photon scattered in a medium\n");
  if (photons && shown.surfaces && s.surface_photons == 0)
    fmt::print(stderr, "warning: the surface photon map is empty: no photon to store met a rough surface\n");
  warn(s.ledger.non_finite, "photons were dropped because their power was not finite");
  warn(s.eye.non_finite, "samples were dropped because they were not finite");
  warn(s.ledger.cut_count, "photons were cut at render.max_events");
  warn(s.eye.gather.least_shares, "estimates at borders had less than a 64th of their kernel left, and are too dark");
  warn(s.eye.cut_paths, "eye paths were cut at render.max_events");
  // Rays through the very edges of boundaries need a correction now and then: some in 1e7. More means media that
  // overlap.
  WalkCounters walk = s.ledger.walk;
  walk.merge(s.eye.walk);
  warn(walk.majorant_violations,
       strategy_info(settings.distance.strategy).positive
           ? "look-ups found more density than a majorant, which cut it: passes are biased until majorants have grown"
           : "look-ups found more density than a majorant: weights grow there and change their signs");
  if (walk.medium_mismatches > 100 + walk.crossings / 1'000'000)
    warn(walk.medium_mismatches,
         "boundaries were met from a medium that is not the one before them: check that media do not overlap");
}

Outputs output_paths(const PassOptions& options, const std::string& name) {
  const fs::path exr = options.output.empty() ? name + ".exr" : options.output;
  if (exr.extension() != ".exr")
    throw InputError(fmt::format("{}: the image is an EXR file, its name must end in .exr", exr.string()));
  const auto beside = [&](const char* extension) { return fs::path(exr).replace_extension(extension); };
  return {exr, beside(".png"), beside(".json"), beside(".checkpoint"), beside(".errors.csv")};
}

void check_outputs(const Outputs& outputs, uint64_t pixels, bool checkpoint, const PassOptions& options,
                   const LoadedScene& loaded) {
  constexpr uint64_t kReportBytes = 1 << 16;
  const bool discs = loaded.settings.radii == RadiusSchedule::per_pixel && scattering_of(loaded.scene).surfaces;
  const uint64_t pixel = Film::kBytesOfPixel + (discs ? sizeof(PixelDisc) : 0);
  const uint64_t film = checkpoint ? 2 * pixels * pixel : 0;                      // the checkpoint, and its successor
  const uint64_t bytes = pixels * (9 * sizeof(float) + 3) + film + kReportBytes;  // of all, which share a folder
  std::vector<fs::path> written{outputs.exr, outputs.png, outputs.json};
  if (checkpoint) written.push_back(outputs.checkpoint);
  std::vector<std::string> read = loaded.files;
  read.push_back(options.scene);
  for (const fs::path& path : written) {
    check_writable(path, bytes);
    for (const std::string& file : read)
      if (std::error_code none; fs::equivalent(path, file, none))
        throw InputError(fmt::format("cannot write '{}': the scene is read from '{}'; name another output with -o",
                                     path.string(), file));
  }
}

void apply_options(const PassOptions& options, RenderSettings& settings) {
  if (options.seed) settings.seed = *options.seed;
  if (!options.passes) return;
  settings.passes = *options.passes;
  settings.seconds = settings.error = 0.0;
}

void refuse_automatic(const LoadedScene& loaded, const std::string& command) {
  if (loaded.automatic.any())
    throw InputError(fmt::format(
        "{} chooses no settings: name a value where one is \"auto\"; vpm render tells those that it chooses", command));
}

Metadata provenance(const PassOptions& options, const LoadedScene& loaded, const Film& film) {
  return {{"vpm.version", std::string(version())},
          {"vpm.scene", fs::path(options.scene).filename().string()},
          {"vpm.sceneHash", loaded.hash},
          {"vpm.overrides", fmt::format("{}", fmt::join(options.overrides, " "))},
          {"vpm.settings", settings_line(loaded.settings)},
          {"vpm.seed", std::to_string(loaded.settings.seed)},
          {"vpm.passes", std::to_string(film.passes())}};
}

}  // namespace vpm::tools
