// Signals, warnings and paths.
#include "pass_run.h"

#include <fmt/format.h>
#include <csignal>
#include <cstdio>

#include "base/error.h"

namespace vpm::tools {
namespace {

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

void print_warnings(const LoadedScene& loaded, const Stages& stages, const RenderStatistics& s) {
  for (const std::string& note : loaded.notes) fmt::print(stderr, "note: {}\n", note);
  const auto warn = [](uint64_t count, const char* what) {
    if (count > 0) fmt::print(stderr, "warning: {} {}\n", count, what);
  };
  if (stages.volume_map && s.volume_photons == 0)
    fmt::print(stderr, "warning: the volume photon map is empty: no photon scattered in a medium\n");
  if (stages.surface_map && s.surface_photons == 0)
    fmt::print(stderr, "warning: the surface photon map is empty: no photon to store met a rough surface\n");
  warn(s.ledger.non_finite, "photons were dropped because their power was not finite");
  warn(s.eye.non_finite, "samples were dropped because they were not finite");
  warn(s.ledger.cut_count, "photons were cut at render.max_events");
  warn(s.eye.cut_paths, "eye paths were cut at render.max_events");
  // Rays through the very edges of boundaries need a correction now and then: some in 1e7. More means media that
  // overlap.
  WalkCounters walk = s.ledger.walk;
  walk.merge(s.eye.walk);
  if (walk.medium_mismatches > 100 + walk.crossings / 1'000'000)
    warn(walk.medium_mismatches,
         "boundaries were met from a medium that is not the one before them: check that media do not overlap");
}

std::filesystem::path exr_path(const std::string& output, const std::string& scene) {
  namespace fs = std::filesystem;
  const fs::path exr = output.empty() ? fs::path(scene).filename().replace_extension(".exr") : fs::path(output);
  if (exr.extension() != ".exr")
    throw InputError(fmt::format("{}: the image is an EXR file, its name must end in .exr", exr.string()));
  return exr;
}

}  // namespace vpm::tools
