// vpm measure: scene file in; power through its detectors, with errors, out.
#include <fmt/format.h>
#include <algorithm>
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

/// A text of each channel; of grey scenes of all.
template <class One>
std::string of_channels(bool grey, One&& one) {
  return grey ? one(0) : fmt::format("({}, {}, {})", one(0), one(1), one(2));
}

/// "0.097395 +- 0.00009"; "none" of a share of no light.
std::string text_of(const Rgbd& value, const Rgbd& error, bool grey) {
  return of_channels(
      grey, [&](int c) { return std::isnan(value[c]) ? "none" : fmt::format("{:.6g} +- {:.2g}", value[c], error[c]); });
}
std::string text_of(const ChannelMoments& power, bool grey) {
  return text_of(power.mean(), power.standard_error(), grey);
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

void print_shares(const std::vector<SlabShare>& shares, bool grey) {
  if (!shares.empty()) fmt::print("shares of what falls on the slab:\n");
  for (const SlabShare& share : shares)
    fmt::print("  {:<12} {}  exact {}\n", share.name, text_of(share.share, share.standard_error, grey),
               of_channels(grey, [&](int c) { return fmt::format("{:.7g}", share.exact[c]); }));
}

/// What is not known, as the errors of a single pass, is null.
Json channels(const Rgbd& value) {
  Json list = Json::array();
  for (int c = 0; c < 3; ++c) list.push_back(std::isnan(value[c]) ? Json() : Json(value[c]));
  return list;
}

/// What is printed and written.
Json json_of(const RenderJob& job, const SlabMeasurement& measured) {
  Json all = {{"scene", job.source}, {"grey", job.scene.grey}};
  all.update(Json::parse(json_of(measured.measurement, job.scene)));
  for (const SlabShare& share : measured.shares)
    all["slab"][share.name] = {{"share", channels(share.share)},
                               {"standard_error", channels(share.standard_error)},
                               {"exact", channels(share.exact)}};
  return all;
}

std::string page_of(const Json& measurement) {
  std::string_view rest = measure_template();
  const std::string page = up_to(rest, "@measurement@", measurement.dump());
  return page + std::string(rest);
}

constexpr const char* kNoArrivals =
    "light from infinity begins at the box around all shapes: detectors that reach beyond count what leaves, not what "
    "comes";
/// Does a detector reach to where light from infinity has not begun?
bool counts_no_arrivals(const Scene& scene) {
  if (scene.period || std::none_of(scene.lights.begin(), scene.lights.end(), is_infinite)) return false;
  return std::any_of(scene.detectors.begin(), scene.detectors.end(), [&](const Detector& detector) {
    const Box around = bounds_of(detector);
    const auto* const plane = std::get_if<PlaneDetector>(&detector.kind);
    return plane || (!around.empty() && !(scene.bounds.contains(around.lo) && scene.bounds.contains(around.hi)));
  });
}

void print_measurement(const Measurement& measured, const Scene& scene) {
  fmt::print("{}, {} photons\n", passes_text(measured.run.passes), measured.run.ledger.emitted_count);
  for (size_t i = 0; i < scene.detectors.size(); ++i) print_detector(measured.detectors[i], scene.grey);
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
  if (counts_no_arrivals(job.scene)) job.notes.push_back(kNoArrivals);
  print_notes(job);
  const CancelScope scope(stop_on_signals());
  const PhotonRun run = photon_run(options);
  const SlabMeasurement measured = measure_scene(job.scene, job.settings, run);
  const PhotonPasses& passes = measured.measurement.run;
  const Json json = json_of(job, measured);
  if (const std::filesystem::path output = options.output; !output.empty())
    write_text(output, output.extension() == ".html" ? page_of(json) : json.dump(2) + "\n");
  print_warnings(warnings_of(passes.ledger));
  if (options.json) {
    fmt::print("{}\n", json.dump(2));
  } else {
    print_measurement(measured.measurement, job.scene);
    print_shares(measured.shares, job.scene.grey);
  }
  return passes.interrupted ? say_interrupted(run.until, passes.passes) : 0;
}

}  // namespace vpm::tools
