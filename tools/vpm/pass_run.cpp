// Warnings, and paths that can be written without harm.
#include "pass_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <regex>

#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/film/view_layers.h"
#include "vpm/image/metrics.h"
#include "vpm/image/png.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/job/checkpoint.h"

namespace vpm::tools {
namespace fs = std::filesystem;

void print_notes(const RenderJob& job) {
  for (const std::string& note : job.notes) fmt::print(stderr, "note: {}\n", note);
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
}

int say_interrupted(const StopRule& until, int passes) {
  if (passes == 0)
    fmt::print(stderr, "interrupted before the first pass was finished: nothing is written\n");
  else if (until.counts_passes())
    fmt::print(stderr, "interrupted after {} of {} passes\n", passes, until.passes);
  else
    fmt::print(stderr, "interrupted after {}\n", passes_text(passes));
  return kInterrupted;
}

Outputs output_paths(const std::string& image, const std::string& name) {
  const fs::path exr = image.empty() ? name + ".exr" : image;
  if (exr.extension() != ".exr")
    throw InputError(fmt::format("{}: the image is an EXR file, its name must end in .exr", exr.string()));
  if (std::regex_search(exr.filename().string(), std::regex("%[0-9]*d")))
    throw InputError(fmt::format(
        "{}: a name with %d is for the frames of a sequence, and one picture is rendered; name a file for it",
        exr.string()));
  const auto with_extension = [&](const char* extension) { return fs::path(exr).replace_extension(extension); };
  return {exr, with_extension(".png"), with_extension(".json"), with_extension(".checkpoint"),
          with_extension(".errors.csv")};
}

void check_outputs(const Outputs& outputs, uint64_t pixels, bool checkpoint, const RenderJob& job) {
  constexpr uint64_t kReportBytes = 1 << 16;
  const uint64_t film = checkpoint ? 2 * checkpoint_bytes(job) : 0;  // the checkpoint, and its successor
  const uint64_t channels = 9 + layer_channels(job.settings);
  const uint64_t bytes = pixels * (channels * sizeof(float) + 3) + film + kReportBytes;  // of all, which share a folder
  std::vector<fs::path> written{outputs.exr, outputs.png, outputs.json};
  if (checkpoint) written.push_back(outputs.checkpoint);
  for (const fs::path& path : written) {
    check_writable(path, bytes);
    check_not_read(path, job);
  }
}

void write_preview(const Outputs& outputs, const std::optional<float>& exposure, const Image& picture,
                   const Image& exposed_by) {
  write_png(outputs.png, picture, exposure ? *exposure : auto_exposure(exposed_by));
}

Image without_fire(const Scene& scene, Image picture) {
  constexpr double kMost = 0.5;   // of a pixel's light may be emitted
  constexpr size_t kFewest = 20;  // pixels, of which one must be left
  if (!scene.has_emitting_media()) return picture;
  const auto lit = [](const Rgb& pixel) { return is_finite(pixel) && luminance(pixel) > 0.0f; };
  const auto width = static_cast<size_t>(picture.width);
  Image rest = picture;
  parallel_for_chunks(picture.pixels.size(), width, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      if (!lit(picture.pixels[i])) continue;
      const Vec2 film(static_cast<float>(i % width) + 0.5f, static_cast<float>(i / width) + 0.5f);
      const Rgb emitted(view_along(scene, scene.camera.ray(film)).passage.emission);
      if (luminance(emitted) > kMost * luminance(picture.pixels[i])) rest.pixels[i] = Rgb(0.0f);
    }
  });
  const auto count = [&](const Image& image) { return std::count_if(image.pixels.begin(), image.pixels.end(), lit); };
  return count(rest) * static_cast<std::ptrdiff_t>(kFewest) < count(picture) ? picture : rest;
}

void apply_options(const PassOptions& options, RenderSettings& settings) {
  if (options.seed) settings.seed = *options.seed;
  if (options.passes) settings.until = {.passes = *options.passes};
}

PhotonRun photon_run(const CountOptions& options) {
  return {{.passes = options.passes, .seconds = options.seconds.value_or(0.0)}, clock_of_process(), options.progress};
}

}  // namespace vpm::tools
