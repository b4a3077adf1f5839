// vpm measure: scene file in; power through its detectors, with errors, out.
#include <fmt/format.h>
#include <algorithm>
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

/// "0.097395 +- 0.00009", of grey scenes; of others for each channel. As a share of `whole`; "none" where that is 0.
std::string text_of(const ChannelMoments& power, bool grey, const Rgbd& whole = Rgbd(1.0)) {
  const Rgbd mean = power.mean() / whole, error = power.standard_error() / whole;
  const auto one = [&](int c) { return whole[c] == 0.0 ? "none" : fmt::format("{:.6g} +- {:.2g}", mean[c], error[c]); };
  return grey ? one(0) : fmt::format("({}, {}, {})", one(0), one(1), one(2));
}

/// What is within its error of 0 is 0.
double value_of(const exact::Bounded& bounded) {
  return std::abs(bounded.value) <= bounded.error ? 0.0 : bounded.value;
}

std::string text_of(const std::array<double, 3>& values, bool grey) {
  return grey ? fmt::format("{:.7g}", values[0])
              : fmt::format("({:.7g}, {:.7g}, {:.7g})", values[0], values[1], values[2]);
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

/// What a slab does with light, of what falls on it.
struct SlabShare {
  const char* name;
  const ChannelMoments& power;
  std::array<double, 3> exact;
};
std::vector<SlabShare> shares_of(const std::optional<SlabScene>& slab, const Measurement& measured) {
  if (!slab) return {};
  const auto solutions = solve(*slab);
  const auto exact_of = [&](exact::Bounded exact::SlabSolution::*value) {
    return std::array{value_of(solutions[0].*value), value_of(solutions[1].*value), value_of(solutions[2].*value)};
  };
  const DetectorReading* const faces = measured.detectors.data() + (measured.detectors.size() - slab->faces.size());
  return {{"reflected", faces[0].forward, exact_of(&exact::SlabSolution::reflected)},
          {"transmitted", faces[1].forward, exact_of(&exact::SlabSolution::transmitted)},
          {"absorbed", measured.absorbed_in_media, exact_of(&exact::SlabSolution::absorbed)}};
}

void print_shares(const std::vector<SlabShare>& shares, const Rgbd& emitted, bool grey) {
  if (!shares.empty()) fmt::print("shares of what falls on the slab:\n");
  for (const SlabShare& share : shares)
    fmt::print("  {:<12} {}  exact {}\n", share.name, text_of(share.power, grey, emitted), text_of(share.exact, grey));
}

/// The errors of a single pass are not known.
Json channels(const Rgbd& value) {
  Json list = Json::array();
  for (int c = 0; c < 3; ++c) list.push_back(std::isnan(value[c]) ? Json() : Json(value[c]));
  return list;
}

/// What is printed and written.
Json json_of(const RenderJob& job, const std::vector<SlabShare>& shares, const Measurement& measured) {
  Json all = {{"scene", job.source}, {"grey", job.scene.grey}};
  all.update(Json::parse(json_of(measured, job.scene)));
  const Rgbd whole = measured.emitted.mean();
  for (const SlabShare& share : shares)
    all["slab"][share.name] = {{"share", channels(share.power.mean() / whole)},
                               {"standard_error", channels(share.power.standard_error() / whole)},
                               {"exact", share.exact}};
  return all;
}

std::string page_of(const Json& measurement) {
  std::string_view rest = measure_template();
  const std::string page = up_to(rest, "@measurement@", measurement.dump());
  return page + std::string(rest);
}

/// Does a detector reach to where light from infinity has not begun?
bool counts_no_arrivals(const Scene& scene) {
  if (scene.period || std::none_of(scene.lights.begin(), scene.lights.end(), is_infinite)) return false;
  return std::any_of(scene.detectors.begin(), scene.detectors.end(), [&](const Detector& detector) {
    const Box around = bounds_of(detector);
    const auto* const plane = std::get_if<PlaneDetector>(&detector.kind);
    return plane || (!around.empty() && !(scene.bounds.contains(around.lo) && scene.bounds.contains(around.hi)));
  });
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
  if (counts_no_arrivals(job.scene))
    job.notes.push_back(
        "light from infinity begins at the box around all shapes: detectors that reach beyond count what leaves, not "
        "what "
        "comes");
  print_notes(job);
  const std::optional<SlabScene> slab = slab_of(job.scene);
  std::vector<Detector> detectors = job.scene.detectors;
  if (slab) detectors.insert(detectors.end(), slab->faces.begin(), slab->faces.end());
  const CancelScope scope(stop_on_signals());
  const PhotonRun run = photon_run(options);
  const Measurement measured = measure(job.scene, job.settings, detectors, run);
  const std::vector<SlabShare> shares = shares_of(slab, measured);
  const Json json = json_of(job, shares, measured);
  if (const std::filesystem::path output = options.output; !output.empty())
    write_text(output, output.extension() == ".html" ? page_of(json) : json.dump(2) + "\n");
  print_warnings(warnings_of(measured.run.ledger));
  if (options.json) {
    fmt::print("{}\n", json.dump(2));
  } else {
    print_measurement(measured, job.scene, job.scene.detectors.size());
    print_shares(shares, measured.emitted.mean(), job.scene.grey);
  }
  return measured.run.interrupted ? say_interrupted(run.until, measured.run.passes) : 0;
}

}  // namespace vpm::tools
