// vpm measure: scene file in; power through its detectors, with errors, out.
#include <fmt/format.h>
#include <array>
#include <cmath>
#include <cstdio>

#include "commands.h"
#include "page/embedded.h"
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
  if (path.extension() != ".json" && path.extension() != ".html")
    throw InputError(fmt::format("{}: measurements are written as .json, or as a page, .html", path.string()));
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

/// What a slab does with light, as shares of what falls on it.
struct SlabShare {
  const char* name;
  const ChannelMoments& power;
  exact::Bounded exact::SlabSolution::*exact;
};
std::array<SlabShare, 3> shares_of(const SlabScene& slab, const Measurement& measured) {
  const DetectorReading* const faces = measured.detectors.data() + (measured.detectors.size() - slab.faces.size());
  return {{{"reflected", faces[0].forward, &exact::SlabSolution::reflected},
           {"transmitted", faces[1].forward, &exact::SlabSolution::transmitted},
           {"absorbed", measured.absorbed_in_media, &exact::SlabSolution::absorbed}}};
}

void print_slab(const SlabScene& slab, const Measurement& measured, bool grey) {
  const auto solutions = solve(slab);
  fmt::print("shares of what falls on the slab:\n");
  for (const SlabShare& share : shares_of(slab, measured)) {
    const exact::Bounded values[3] = {solutions[0].*share.exact, solutions[1].*share.exact, solutions[2].*share.exact};
    fmt::print("  {:<12} {}  exact {}\n", share.name, text_of(share.power, grey, measured.emitted.mean()),
               text_of(values, grey));
  }
}

/// The errors of a single pass are not known.
Json channels(const Rgbd& value) {
  Json list = Json::array();
  for (int c = 0; c < 3; ++c) list.push_back(std::isnan(value[c]) ? Json() : Json(value[c]));
  return list;
}

/// What is printed and written.
Json json_of(const RenderJob& job, const std::optional<SlabScene>& slab, const Measurement& measured) {
  Json all = {{"scene", job.source}, {"grey", job.scene.grey}};
  all.update(Json::parse(json_of(measured, job.scene)));
  if (!slab) return all;
  const auto solutions = solve(*slab);
  for (const SlabShare& share : shares_of(*slab, measured)) {
    const Rgbd whole = measured.emitted.mean();
    all["slab"][share.name] = {
        {"share", channels(share.power.mean() / whole)},
        {"standard_error", channels(share.power.standard_error() / whole)},
        {"exact",
         {(solutions[0].*share.exact).value, (solutions[1].*share.exact).value, (solutions[2].*share.exact).value}}};
  }
  return all;
}

std::string page_of(const Json& measurement) {
  std::string_view rest = measure_template();
  const std::string page = up_to(rest, "@measurement@", measurement.dump());
  return page + std::string(rest);
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
  const Json json = json_of(job, slab, measured);
  if (const std::filesystem::path output = options.output; !output.empty())
    write_text(output, output.extension() == ".html" ? page_of(json) : json.dump(2) + "\n");
  print_warnings(warnings_of(measured.run.ledger));
  if (options.json) {
    fmt::print("{}\n", json.dump(2));
  } else {
    print_measurement(measured, job.scene, job.scene.detectors.size());
    if (slab) print_slab(*slab, measured, job.scene.grey);
  }
  return measured.run.interrupted ? say_interrupted(run.until, measured.run.passes) : 0;
}

}  // namespace vpm::tools
