// vpm measure: scene file in; power through its detectors, with errors, out.
#include <fmt/format.h>
#include <cstdio>

#include "commands.h"
#include "pass_run.h"
#include "this_process.h"
#include "vpm/base/atomic_file.h"
#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/input/scene_file.h"
#include "vpm/job/measurement.h"
#include "vpm/job/messages.h"
#include "vpm/study/exact/slab_scene.h"

namespace vpm::tools {
namespace {

void check_measurement_file(const std::filesystem::path& path, const RenderJob& job) {
  if (path.empty()) return;
  if (path.extension() != ".json")
    throw InputError(fmt::format("{}: measurements are written as .json", path.string()));
  check_writable(path, 0);
  check_not_read(path, job);
}

/// "0.097395 +- 0.00009", of grey scenes; of others for each channel. As a share of `whole`.
std::string text_of(const ChannelMoments& power, bool grey, const Rgbd& whole = Rgbd(1.0)) {
  const Rgbd mean = power.mean() / whole, error = power.standard_error() / whole;
  const auto one = [&](int c) { return fmt::format("{:.6g} +- {:.2g}", mean[c], error[c]); };
  return grey ? one(0) : fmt::format("({}, {}, {})", one(0), one(1), one(2));
}

std::string text_of(const exact::Bounded (&values)[3], bool grey) {
  return grey ? fmt::format("{:.7g}", values[0].value)
              : fmt::format("({:.7g}, {:.7g}, {:.7g})", values[0].value, values[1].value, values[2].value);
}

void print_detector(const DetectorReading& reading, bool grey) {
  fmt::print("  {}\n", reading.detector.name);
  if (reading.detector.of_medium()) {
    fmt::print("    absorbed  {} W, {} collisions\n", text_of(reading.forward, grey), reading.forward_count);
    return;
  }
  fmt::print("    forward   {} W, {} photons\n", text_of(reading.forward, grey), reading.forward_count);
  fmt::print("    backward  {} W, {} photons\n", text_of(reading.backward, grey), reading.backward_count);
}

/// What a slab's faces counted, as shares of the power that was emitted, beside what is exact.
void print_slab(const SlabScene& slab, const Measurement& measured, bool grey) {
  const auto solutions = solve(slab);
  const Rgbd emitted = measured.emitted.mean();
  const auto line = [&](const char* name, const ChannelMoments& power, exact::Bounded exact::SlabSolution::*value) {
    const exact::Bounded values[3] = {solutions[0].*value, solutions[1].*value, solutions[2].*value};
    fmt::print("  {:<12} {}  exact {}\n", name, text_of(power, grey, emitted), text_of(values, grey));
  };
  const size_t faces = measured.detectors.size() - slab.faces.size();
  fmt::print("shares of what falls on the slab:\n");
  line("reflected", measured.detectors[faces].forward, &exact::SlabSolution::reflected);
  line("transmitted", measured.detectors[faces + 1].forward, &exact::SlabSolution::transmitted);
  line("absorbed", measured.absorbed_in_media, &exact::SlabSolution::absorbed);
}

void print_measurement(const Measurement& measured, const Scene& scene, size_t detectors) {
  fmt::print("{}, {} photons\n", passes_text(measured.run.passes), measured.run.ledger.emitted_count);
  for (size_t i = 0; i < detectors; ++i) print_detector(measured.detectors[i], scene.grey);
  fmt::print("  emitted {} W; absorbed in media {} W, on surfaces {} W; escaped {} W\n",
             text_of(measured.emitted, scene.grey), text_of(measured.absorbed_in_media, scene.grey),
             text_of(measured.absorbed_on_surfaces, scene.grey), text_of(measured.escaped, scene.grey));
}

}  // namespace

int measure_command(const MeasureOptions& options) {
  set_threads(options.threads);
  RenderJob job = load_scene(options.scene, components_first(options.overrides));
  check_measurement_file(options.output, job);
  refuse_automatic(job, "vpm measure");
  if (options.seed) job.settings.seed = *options.seed;
  print_notes(job);
  const std::optional<SlabScene> slab = slab_of(job.scene);
  std::vector<Detector> detectors = job.scene.detectors;
  if (slab) detectors.insert(detectors.end(), slab->faces.begin(), slab->faces.end());
  const CancelScope scope(stop_on_signals());
  const PhotonRun run = photon_run(options);
  const Measurement measured = measure(job.scene, job.settings, detectors, run);
  const std::string json = json_of(measured, job.scene);
  if (!options.output.empty()) write_text(options.output, json);
  print_warnings(warnings_of(measured.run.ledger));
  if (options.json) {
    fmt::print("{}", json);
  } else {
    print_measurement(measured, job.scene, job.scene.detectors.size());
    if (slab) print_slab(*slab, measured, job.scene.grey);
  }
  return measured.run.interrupted ? say_interrupted(run.until, measured.run.passes) : 0;
}

}  // namespace vpm::tools
